#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tamp::runtime
{

/// A task, or the step as a whole, in two runs.
struct TaskComparison {
  std::string name;
  /// Of a step [s], on all ranks and patches together: the median over the parts that both runs have; 0 where a run has
  /// no such task.
  double here_s = 0;
  double there_s = 0;
  /// How much longer it takes there: the median over those parts, and its standard error; both 0 where there are fewer
  /// than eight.
  double ratio = 0;
  double error = 0;

  /// Whether the two differ by more than three standard errors.
  bool differs() const;
};

/// Two runs, given as their `profile.json`, as far as both go. Each part of one is compared with that of the same steps
/// of the other, so that costs that change as a run goes on are no noise. The step comes first, then the tasks with the
/// largest differences.
std::vector<TaskComparison> compare_profiles(const nlohmann::json& here, const nlohmann::json& there);

std::string to_text(const std::vector<TaskComparison>& tasks);
nlohmann::json to_json(const std::vector<TaskComparison>& tasks);

}  // namespace tamp::runtime
