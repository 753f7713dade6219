#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tamp::runtime
{

/// A task, or the step as a whole, in two runs.
struct TaskComparison {
  std::string name;
  /// Time in a step [s], on all ranks and patches together: the median over the parts that both runs have, or the mean
  /// where most of them do without the task; empty where a run has no such task.
  std::optional<double> here_s{};
  std::optional<double> there_s{};
  /// Time there over time here: the median over those parts, and its standard error; both 0 where there are fewer than
  /// eight.
  double ratio = 0;
  double error = 0;

  /// Whether the two differ by more than three standard errors.
  bool differs() const;
};

/// Compares two runs, given as their `profile.json`, over the steps that both have. Each part of one is compared with
/// the same steps of the other, so that costs that change as a run goes on are no noise. Two runs that have no whole
/// part in common are listed with their own numbers and no ratio. The step comes first, then the tasks with the largest
/// differences.
std::vector<TaskComparison> compare_profiles(const nlohmann::json& here, const nlohmann::json& there);

/// A line on runs of unlike ranks or threads, or on unlike machines; empty for others. Throws nlohmann's exceptions for
/// what no run has written.
std::string unlike_text(const nlohmann::json& here, const nlohmann::json& there);

std::string to_text(const std::vector<TaskComparison>& tasks);
nlohmann::json to_json(const std::vector<TaskComparison>& tasks);

}  // namespace tamp::runtime
