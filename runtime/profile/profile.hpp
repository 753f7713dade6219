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
  /// Of `total_s`, in which other programs may have had the core: what the processor worked, by samples; NaN where none
  /// was taken.
  double processor_s = std::numeric_limits<double>::quiet_NaN();
  double bytes = 0;
  double particles = 0;
  /// Time of the busiest patch over the mean of all patches.
  double imbalance = 1;
  /// Between the end of the last predecessor and the start, summed: ready, but others had their turn.
  double ready_delay_s = 0;
  /// In the mean step, what of the longest chain is this task; and in which part of the steps that were looked at the
  /// longest chain of a rank goes through it.
  double chain_s = 0;
  double on_chain = 0;
  /// Of the busiest rank over the mean of all ranks.
  double rank_imbalance = 1;
  /// In each part of the run, of a step in the mean; all ranks and patches together.
  std::vector<double> over_time_s{};
  /// What part of the mean step is saved if every instance takes a tenth less, and if none takes any time; NaN where
  /// that was not found out.
  double gain_of_tenth = std::numeric_limits<double>::quiet_NaN();
  double gain_of_all = std::numeric_limits<double>::quiet_NaN();
};

/// What one rank did.
struct RankStatistics {
  std::vector<TaskStatistics> tasks{};
  double step_s = 0;
  double between_s = 0;
  double overhead = 0;
};

struct PatchStatistics {
  /// That it belongs to at the end.
  int rank = 0;
  double total_s = 0;
  /// The task that took most.
  std::string dearest;
};

/// A task of the longest chain of the mean step.
struct ChainLink {
  std::string task;
  /// -1 for what belongs to a rank as a whole.
  int patch = -1;
  int rank = 0;
  double task_s = 0;
  /// Before it, from being sent to being seen: of a message that it receives.
  double message_s = 0;
};

/// What an instance of a task takes in the mean step [s], and how long the message that it receives is on its way.
struct InstanceTime {
  std::string task;
  /// -1 for what belongs to a rank as a whole, and for all groups.
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

/// Whether other programs had the cores for so long that what was measured says little of this one.
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
  /// A run in parts of so many steps, the last of which may have fewer: what a step takes in each in the mean.
  long steps_each_part = 0;
  std::vector<double> step_over_time_s;
  long n_steps = 0;
  long n_traced_steps = 0;
  /// Mean time of a step, on the rank where steps take longest, of its longest chain of tasks on one rank, and the
  /// share of the workers' time outside of task bodies.
  double step_s = 0;
  double critical_path_s = 0;
  double overhead = 0;
  /// The longest chain of the mean step through tasks and messages of all ranks: a step is no shorter on any number of
  /// threads. And how long the mean step takes when it is replayed, beside `step_s`; 0 where it was not.
  double longest_chain_s = 0;
  double replayed_s = 0;
  /// The mean step, in the order of its graph; empty where that is large.
  std::vector<InstanceTime> mean_step;
  /// That chain, first to last.
  std::vector<ChainLink> chain;
  /// What the record itself takes, and all that the host does between steps, for each step, on that rank, too.
  double recording_s = 0;
  double between_s = 0;
  /// The part of tasks' time in which workers had their cores, by samples; NaN where these are too few to tell.
  double core_share = std::numeric_limits<double>::quiet_NaN();
  /// The longest first; the time is that of all workers of all ranks.
  std::vector<Wait> waits;
  /// Messages between ranks: how many, how long, how long on their way in sum, and the part of that in which the worker
  /// that took them in had nothing else to run.
  std::uint64_t n_messages = 0;
  std::uint64_t message_bytes = 0;
  double message_s = 0;
  double message_wait_s = 0;
  /// By the names of labels, the task of the step that makes them, or several with commas between them.
  std::map<std::string, std::string> makers;
};

}  // namespace tamp::runtime
