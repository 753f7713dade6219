#include "runtime/profile/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "runtime/profile/over_time.hpp"

namespace tamp::runtime
{

namespace
{

constexpr std::size_t least_parts = 8;

/// Mean time in a step [s] for each part of a run; all parts have the same number of steps.
using OverTime = std::vector<double>;

/// Joins each `n_joined` parts to one, as their mean; what is left over and fills no whole part is left out.
OverTime joined(const OverTime& parts, std::size_t n_joined)
{
  OverTime result;
  result.reserve(parts.size() / n_joined);
  for (std::size_t k = 0; k + n_joined <= parts.size(); k += n_joined) {
    const auto first = parts.begin() + static_cast<std::ptrdiff_t>(k);
    result.push_back(std::accumulate(first, first + static_cast<std::ptrdiff_t>(n_joined), 0.0) /
                     static_cast<double>(n_joined));
  }
  return result;
}

/// A run's profile, by parts of a number of steps.
class Run
{
 public:
  explicit Run(const nlohmann::json& profile) : profile_(profile)
  {
    steps_each_ = profile.at("over_time").at("steps_each").get<double>();
    // Other values, which no run writes, would join no parts or loop without end.
    if (!(steps_each_ >= 1 && steps_each_ <= 1e15)) throw std::out_of_range("steps_each");
  }

  double steps_each() const { return steps_each_; }
  OverTime step(double steps_each) const { return parts(profile_.at("over_time").at("step_s"), steps_each); }
  std::map<std::string, OverTime> tasks(double steps_each) const
  {
    std::map<std::string, OverTime> all;
    for (const nlohmann::json& t : profile_.at("tasks").get_ref<const nlohmann::json::array_t&>()) {
      all[t.at("name").get<std::string>()] = parts(t.at("over_time_s"), steps_each);
    }
    return all;
  }

 private:
  OverTime parts(const nlohmann::json& written, double steps_each) const
  {
    return joined(written.get<OverTime>(), static_cast<std::size_t>(steps_each / steps_each_));
  }

  const nlohmann::json& profile_;
  double steps_each_;
};

double quantile(const std::vector<double>& sorted, double q)
{
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto k = static_cast<std::size_t>(at);
  const double next = sorted[std::min(k + 1, sorted.size() - 1)];
  return sorted[k] + (at - static_cast<double>(k)) * (next - sorted[k]);
}

/// The typical time of the first `n` parts: their median, or their mean where that is 0.
std::optional<double> typical(const OverTime* all, std::size_t n)
{
  if (all == nullptr) return {};
  OverTime parts(all->begin(), all->begin() + static_cast<std::ptrdiff_t>(std::min(n, all->size())));
  if (parts.empty()) return 0;
  std::sort(parts.begin(), parts.end());
  const double median = quantile(parts, 0.5);
  return median > 0 ? median : std::accumulate(parts.begin(), parts.end(), 0.0) / static_cast<double>(parts.size());
}

/// Compares medians, as a part in which another program had the processor says nothing. The standard error is that of a
/// normal distribution with the same quartiles. Null where a run has no such task.
TaskComparison comparison(const std::string& name, const OverTime* here, const OverTime* there, std::size_t n_parts)
{
  TaskComparison result{name, typical(here, n_parts), typical(there, n_parts)};
  if (here == nullptr || there == nullptr) return result;
  std::vector<double> logarithms;
  for (std::size_t k = 0; k < std::min({n_parts, here->size(), there->size()}); ++k) {
    if ((*here)[k] > 0 && (*there)[k] > 0) logarithms.push_back(std::log((*there)[k] / (*here)[k]));
  }
  if (logarithms.size() < least_parts) return result;
  std::sort(logarithms.begin(), logarithms.end());
  constexpr double deviations_between_quartiles = 1.349, of_a_median = 1.2533;
  const double deviation = (quantile(logarithms, 0.75) - quantile(logarithms, 0.25)) / deviations_between_quartiles;
  result.ratio = std::exp(quantile(logarithms, 0.5));
  result.error = result.ratio * of_a_median * deviation / std::sqrt(static_cast<double>(logarithms.size()));
  return result;
}

/// The comparison of two runs that have no part in common, which has no ratio.
TaskComparison without_ratio(TaskComparison comparison)
{
  comparison.ratio = comparison.error = 0;
  return comparison;
}

double difference(const TaskComparison& task)
{
  return std::abs(task.there_s.value_or(0) - task.here_s.value_or(0));
}

std::string ratio_text(const TaskComparison& task)
{
  if (!task.here_s) return "only there";
  if (!task.there_s) return "only here";
  if (task.ratio == 0) return "too short to tell";
  return fmt::format("{:>7.3f} +- {:.3f}  {}", task.ratio, task.error,
                     !task.differs()  ? ""
                     : task.ratio > 1 ? "slower there"
                                      : "faster there");
}

}  // namespace

bool TaskComparison::differs() const
{
  return ratio > 0 && std::abs(ratio - 1) > 3 * error;
}

std::vector<TaskComparison> compare_profiles(const nlohmann::json& here, const nlohmann::json& there)
{
  const Run one(here), other(there);
  double each_here = std::max(one.steps_each(), other.steps_each()), each_there = each_here;
  const bool in_common = !one.step(each_here).empty() && !other.step(each_there).empty();
  if (!in_common) {
    each_here = one.steps_each();
    each_there = other.steps_each();
  }
  const OverTime step_here = one.step(each_here), step_there = other.step(each_there);
  const std::size_t n_parts = in_common ? std::min(step_here.size(), step_there.size()) : RunParts::most;
  const auto tasks_here = one.tasks(each_here), tasks_there = other.tasks(each_there);
  const auto found = [](const auto& tasks, const std::string& name) {
    const auto at = tasks.find(name);
    return at == tasks.end() ? nullptr : &at->second;
  };
  std::vector<TaskComparison> all{comparison("a step", &step_here, &step_there, n_parts)};
  for (const auto& [name, parts] : tasks_here) {
    all.push_back(comparison(name, &parts, found(tasks_there, name), n_parts));
  }
  for (const auto& [name, parts] : tasks_there) {
    if (!tasks_here.contains(name)) all.push_back(comparison(name, nullptr, &parts, n_parts));
  }
  if (!in_common) std::transform(all.begin(), all.end(), all.begin(), without_ratio);
  std::stable_sort(all.begin() + 1, all.end(),
                   [](const TaskComparison& a, const TaskComparison& b) { return difference(a) > difference(b); });
  return all;
}

std::string unlike_text(const nlohmann::json& here, const nlohmann::json& there)
{
  // Earlier versions did not write what a run ran on.
  if (!here.contains("machine") || !there.contains("machine")) return "";
  std::string unlike;
  for (const auto& [key, words] : {std::pair{"ranks", "ranks"},
                                   {"threads", "threads of each"},
                                   {"processor", "processor"},
                                   {"instruction_set", "instructions"}}) {
    const nlohmann::json &own = here.at("machine").at(key), &other = there.at("machine").at(key);
    if (own != other)
      unlike += fmt::format("{}{} {} here, {} there", unlike.empty() ? "" : "; ", words, own.dump(), other.dump());
  }
  return unlike.empty() ? "" : "runs that differ in more than their tasks: " + unlike + "\n";
}

std::string to_text(const std::vector<TaskComparison>& tasks)
{
  std::string text = fmt::format("{:<36} {:>12} {:>12}  {}\n", "microseconds a step", "here", "there", "there / here");
  for (const TaskComparison& task : tasks) {
    text += fmt::format("{:<36} {:>12.2f} {:>12.2f}  {}\n", task.name, task.here_s.value_or(0) * 1e6,
                        task.there_s.value_or(0) * 1e6, ratio_text(task));
  }
  return text + "here: this run; there: the other; there / here: median ratio of their parts +- its standard error\n";
}

nlohmann::json to_json(const std::vector<TaskComparison>& tasks)
{
  nlohmann::json list = nlohmann::json::array();
  for (const TaskComparison& task : tasks) {
    list.push_back({{"name", task.name}});
    if (task.here_s) list.back()["here_s"] = *task.here_s;
    if (task.there_s) list.back()["there_s"] = *task.there_s;
    if (task.ratio == 0) continue;
    list.back()["ratio"] = task.ratio;
    list.back()["error"] = task.error;
    list.back()["differs"] = task.differs();
  }
  return list;
}

}  // namespace tamp::runtime
