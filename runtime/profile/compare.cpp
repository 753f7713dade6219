#include "runtime/profile/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace tamp::runtime
{

namespace
{

constexpr std::size_t least_parts = 8;

/// What a step takes in each part of a run, the parts as long as asked for [s].
using OverTime = std::vector<double>;

/// Joins so many parts to one each; a rest that makes no whole part is left out.
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
    // What no run has written would never end, or join no parts.
    if (!(steps_each_ >= 1 && steps_each_ <= 1e15)) throw std::out_of_range("steps_each");
  }

  double steps_each() const { return steps_each_; }
  OverTime step(double steps_each) const { return parts(profile_.at("over_time").at("step_s"), steps_each); }
  std::map<std::string, OverTime> tasks(double steps_each) const
  {
    std::map<std::string, OverTime> all;
    for (const nlohmann::json& t : profile_.at("tasks")) {
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

/// Of the first `n`.
double median(OverTime parts, std::size_t n)
{
  parts.resize(std::min(n, parts.size()));
  std::sort(parts.begin(), parts.end());
  return parts.empty() ? 0 : quantile(parts, 0.5);
}

/// By medians, as a part in which something else had the processor tells nothing. The standard error is that of a
/// normal distribution with the same quartiles.
TaskComparison comparison(const std::string& name, const OverTime& here, const OverTime& there, std::size_t n_parts)
{
  TaskComparison result{name, median(here, n_parts), median(there, n_parts)};
  std::vector<double> logarithms;
  for (std::size_t k = 0; k < std::min(here.size(), there.size()); ++k) {
    if (here[k] > 0 && there[k] > 0) logarithms.push_back(std::log(there[k] / here[k]));
  }
  if (logarithms.size() < least_parts) return result;
  std::sort(logarithms.begin(), logarithms.end());
  constexpr double deviations_between_quartiles = 1.349, of_a_median = 1.2533;
  const double deviation = (quantile(logarithms, 0.75) - quantile(logarithms, 0.25)) / deviations_between_quartiles;
  result.ratio = std::exp(quantile(logarithms, 0.5));
  result.error = result.ratio * of_a_median * deviation / std::sqrt(static_cast<double>(logarithms.size()));
  return result;
}

std::string ratio_text(const TaskComparison& task)
{
  if (task.here_s == 0) return "only there";
  if (task.there_s == 0) return "only here";
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
  const double steps_each = std::max(one.steps_each(), other.steps_each());
  const OverTime step_here = one.step(steps_each), step_there = other.step(steps_each);
  const std::size_t n_parts = std::min(step_here.size(), step_there.size());
  auto tasks_here = one.tasks(steps_each), tasks_there = other.tasks(steps_each);
  std::vector<TaskComparison> all{comparison("a step", step_here, step_there, n_parts)};
  for (const auto& [name, parts] : tasks_here) all.push_back(comparison(name, parts, tasks_there[name], n_parts));
  for (const auto& [name, parts] : tasks_there) {
    if (!tasks_here.contains(name)) all.push_back(comparison(name, {}, parts, n_parts));
  }
  std::stable_sort(all.begin() + 1, all.end(), [](const TaskComparison& a, const TaskComparison& b) {
    return std::abs(a.there_s - a.here_s) > std::abs(b.there_s - b.here_s);
  });
  return all;
}

std::string to_text(const std::vector<TaskComparison>& tasks)
{
  std::string text = fmt::format("{:<36} {:>12} {:>12}  {}\n", "microseconds a step", "here", "there", "there / here");
  for (const TaskComparison& task : tasks) {
    text += fmt::format("{:<36} {:>12.2f} {:>12.2f}  {}\n", task.name, task.here_s * 1e6, task.there_s * 1e6,
                        ratio_text(task));
  }
  return text;
}

nlohmann::json to_json(const std::vector<TaskComparison>& tasks)
{
  nlohmann::json list = nlohmann::json::array();
  for (const TaskComparison& task : tasks) {
    list.push_back({{"name", task.name}, {"here_s", task.here_s}, {"there_s", task.there_s}});
    if (task.ratio == 0) continue;
    list.back()["ratio"] = task.ratio;
    list.back()["error"] = task.error;
    list.back()["differs"] = task.differs();
  }
  return list;
}

}  // namespace tamp::runtime
