#include "tools/study/compare/peak_memory.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tools/system/child_process.hpp"

namespace tamp::tools::compare
{

std::optional<std::size_t> peak_rss_alone(const std::filesystem::path& scene,
                                          const std::vector<std::string>& assignments, int n_threads, long n_steps,
                                          const std::filesystem::path& scratch)
{
  Child child{{"run", scene.string(), "--quiet", "--threads", std::to_string(n_threads), "--steps",
               std::to_string(n_steps), "--out", scratch.string()}};
  for (const std::string& assignment : assignments) {
    child.arguments.insert(child.arguments.end(), {"--set", assignment});
  }
  std::optional<std::size_t> bytes;
  if (run_child(child).done()) {
    const auto summary = nlohmann::json::parse(std::ifstream(scratch / "summary.json"), nullptr, false);
    if (!summary.is_discarded()) bytes = summary["peak_rss_bytes"]["max"].get<std::size_t>();
  }
  std::filesystem::remove_all(scratch);
  return bytes;
}

}  // namespace tamp::tools::compare
