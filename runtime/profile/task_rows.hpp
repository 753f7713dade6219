#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/profile/duration_histogram.hpp"
#include "runtime/profile/over_time.hpp"
#include "runtime/profile/profile.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// Numbers of one task on one rank, which may be sent as bytes; times in ticks.
struct TaskTotals {
  DurationHistogram durations;
  TicksOverTime over_time;
  std::uint64_t skipped = 0;
  // Summed over the steps in which processor time is taken.
  std::uint64_t processor_ns = 0;
  // Summed over the steps that are looked at, like all members below.
  std::uint64_t ready_delay = 0;
  /// Number of these steps in which the rank's longest chain goes through the task.
  std::uint64_t on_chain = 0;
  double bytes = 0;
  double particles = 0;

  void add(const TaskTotals& other);
};

/// A task's totals and its ticks on each patch; one entry where it does not work on patches.
struct TaskRow {
  std::string name;
  /// Category of its instances in a trace: the phase of the step, or the kind of the runtime's own work.
  std::string category{};
  bool over_patches = false;
  TaskTotals totals;
  std::vector<std::uint64_t> per_patch;

  void add(const TaskRow& other);
};

/// Factors that turn the ticks and sums of rows into the numbers of a profile.
struct RowScales {
  /// Time of all tasks together.
  std::uint64_t all_ticks = 0;
  double second_per_tick = 0;
  /// Number of all steps over that of the steps looked at, and over that of the steps with processor time; and the time
  /// of all steps over the time of those looked at.
  double steps = 0;
  double processor_steps = 0;
  double time = 0;
  /// Steps that were looked at, summed over the ranks that the rows are of.
  double looked_at = 0;
  /// The rank that the rows are of, and whose patches alone count for the imbalance; -1 for all ranks.
  int rank = -1;
};

/// Has `look` see the rows of each rank in turn: they are the same on all, as the graph is, and only their numbers
/// travel. Collective.
void for_each_rank(const std::vector<TaskRow>& own, const Communicator& communicator,
                   const std::function<void(int rank, const std::vector<TaskRow>& rows)>& look);

std::uint64_t ticks_of(const std::vector<TaskRow>& rows);

/// Statistics of all tasks that ran or were skipped, most expensive first. `rank_of_patch` is that at the end of the
/// run.
std::vector<TaskStatistics> statistics(const std::vector<TaskRow>& rows, const RowScales& scales,
                                       const std::vector<int>& rank_of_patch);

/// Time of all tasks on each patch [s], and the task that took most of it.
std::vector<PatchStatistics> patch_statistics(const std::vector<TaskRow>& rows, const std::vector<int>& ranks,
                                              double second_per_tick);

}  // namespace tamp::runtime
