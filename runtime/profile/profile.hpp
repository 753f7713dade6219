#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tamp::runtime
{

/// One row of the profile. Times in seconds.
struct TaskStatistics {
  std::string name;
  std::uint64_t count = 0;
  /// Instances that found nothing to work on; they are in none of the other numbers but the wait.
  std::uint64_t skipped = 0;
  double total_s = 0;
  double mean_s = 0;
  double min_s = 0;
  double max_s = 0;
  double p95_s = 0;
  /// Part of the time of all tasks; the shares of all rows add up to 1.
  double share = 0;
  /// Processor time of the task [s], extrapolated from sampled steps; below `total_s` where other programs had the
  /// core. NaN where no step was sampled.
  double processor_s = std::numeric_limits<double>::quiet_NaN();
  double bytes = 0;
  double particles = 0;
  /// Time of the busiest patch over the mean of all patches.
  double imbalance = 1;
  /// Time from the end of the last predecessor to the start, summed over its instances [s]: the task was ready, but the
  /// workers were busy with others.
  double ready_delay_s = 0;
  /// Time that the task takes on the longest chain of the mean step [s]; and the share of the steps that were looked at
  /// in which the longest chain of a rank goes through it.
  double chain_s = 0;
  double on_chain = 0;
  /// Time of the busiest rank over the mean of all ranks.
  double rank_imbalance = 1;
  /// Mean time that it takes in a step [s], for each part of the run; summed over all ranks and patches.
  std::vector<double> over_time_s{};
  /// Share of the mean step that is saved, by replay, if every instance takes a tenth less, and if none takes any time;
  /// NaN where the task was not replayed.
  double gain_of_tenth = std::numeric_limits<double>::quiet_NaN();
  double gain_of_all = std::numeric_limits<double>::quiet_NaN();
};

/// The profile of one rank: its tasks, the mean time of a step and between two steps [s], and its scheduler overhead.
struct RankStatistics {
  std::vector<TaskStatistics> tasks{};
  double step_s = 0;
  double between_s = 0;
  double overhead = 0;
};

struct PatchStatistics {
  /// The rank that the patch belongs to at the end of the run.
  int rank = 0;
  double total_s = 0;
  /// The task that took most.
  std::string dearest;
};

/// A task of the longest chain of the mean step.
struct ChainLink {
  std::string task;
  /// The patch; -1 for what belongs to a rank as a whole.
  int patch = -1;
  int rank = 0;
  double task_s = 0;
  /// Time that the message it receives was on its way before it, from being sent to being seen [s]; 0 if it receives
  /// none.
  double message_s = 0;
};

/// Time of one task instance in the mean step [s], and time that the message it receives was on its way [s].
struct InstanceTime {
  std::string task;
  /// Patch and group; -1 for what belongs to a rank as a whole, and for all groups.
  int patch = -1;
  int group = -1;
  int rank = 0;
  double task_s = 0;
  double message_s = 0;
};

/// Workers that stood still because an instance of `task` waited for one of `cause`; seconds over all steps.
struct Wait {
  std::string task;
  std::string cause;
  double total_s = 0;
};

/// Whether other programs had the cores for so long that the measured times cannot be trusted.
inline bool is_too_busy(double core_share)
{
  constexpr double least_share = 0.9;
  return core_share < least_share;
}

struct Profile {
  /// Most expensive first.
  std::vector<TaskStatistics> tasks;
  std::vector<RankStatistics> ranks;
  std::vector<PatchStatistics> patches;
  /// The run is divided into parts of `steps_each_part` steps, of which the last may have fewer; for each part, the
  /// mean time of a step [s].
  long steps_each_part = 0;
  std::vector<double> step_over_time_s;
  long n_steps = 0;
  long n_traced_steps = 0;
  /// Mean time of a step [s] on the rank where steps take longest; mean time of the longest chain of tasks within one
  /// rank [s]; and the share of the workers' time outside of task bodies.
  double step_s = 0;
  double critical_path_s = 0;
  double overhead = 0;
  /// The longest chain of the mean step through tasks and messages of all ranks: a step is no shorter on any number of
  /// threads. And how long the mean step takes when it is replayed, beside `step_s`; 0 where it was not.
  double longest_chain_s = 0;
  double replayed_s = 0;
  /// The mean step, in the order of its graph; empty where that is large.
  std::vector<InstanceTime> mean_step;
  /// The tasks of the longest chain, first to last.
  std::vector<ChainLink> chain;
  /// Mean time for each step [s] that recording takes, and that passes between two steps (output and the like), on the
  /// rank of `step_s`.
  double recording_s = 0;
  double between_s = 0;
  /// The part of tasks' time in which workers had their cores, by samples; NaN where these are too few to tell.
  double core_share = std::numeric_limits<double>::quiet_NaN();
  /// The longest first; the time is that of all workers of all ranks.
  std::vector<Wait> waits;
  /// Messages between ranks: their number, their size, the time that they were on their way in sum [s], and the part of
  /// that time in which the worker that received them had nothing else to run.
  std::uint64_t n_messages = 0;
  std::uint64_t message_bytes = 0;
  double message_s = 0;
  double message_wait_s = 0;
  /// For each label, by name, the task of the step that makes it, or several with commas between them.
  std::map<std::string, std::string> makers;
};

}  // namespace tamp::runtime
