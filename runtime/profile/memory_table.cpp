#include "runtime/profile/memory_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace tamp::runtime
{

namespace
{

double in_mebibytes(double bytes)
{
  return bytes / (1024 * 1024);
}

/// Numbers by name, the largest first, without those that are next to nothing.
std::vector<std::pair<double, std::string>> sorted(const nlohmann::json& by_name, double total)
{
  constexpr double next_to_nothing = 1e-4;
  std::vector<std::pair<double, std::string>> all;
  const auto& object = by_name.get_ref<const nlohmann::json::object_t&>();
  all.reserve(object.size());
  for (const auto& [name, bytes] : object) {
    if (bytes.get<double>() > next_to_nothing * total) all.emplace_back(bytes.get<double>(), name);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  return all;
}

}  // namespace

std::string memory_text(const nlohmann::json& profile)
{
  const nlohmann::json& memory = profile.at("memory");
  const auto total = memory.at("total").get<double>();
  std::string text = fmt::format("{:.1f} MiB at most, on all ranks\n\n{:<32} {:>9} {:>7} {:>9}\n", in_mebibytes(total),
                                 "label", "MiB then", "share", "MiB most");
  // Earlier versions tell the most of each label alone.
  const nlohmann::json& then = memory.contains("at_high_water") ? memory.at("at_high_water") : memory.at("labels");
  for (const auto& [bytes, label] : sorted(then, total)) {
    text += fmt::format("{:<32} {:>9.2f} {:>6.2f}% {:>9.2f}\n", label, in_mebibytes(bytes), 100 * bytes / total,
                        in_mebibytes(memory.at("labels").at(label).get<double>()));
  }
  text += "MiB then: when all memory together was largest; MiB most: the most that the label held itself\n";
  if (!memory.contains("tasks")) return text;
  text += fmt::format("\n{:<32} {:>9} {:>7}\n", "task that makes it", "MiB then", "share");
  for (const auto& [bytes, task] : sorted(memory.at("tasks"), total)) {
    text += fmt::format("{:<32} {:>9.2f} {:>6.2f}%\n", task, in_mebibytes(bytes), 100 * bytes / total);
  }
  return text;
}

}  // namespace tamp::runtime
