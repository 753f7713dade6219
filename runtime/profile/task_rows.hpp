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
  // Of the steps in which it is taken.
  std::uint64_t processor_ns = 0;
  // Of the steps that are looked at, like all below.
  std::uint64_t ready_delay = 0;
  /// In how many of them the rank's longest chain goes through the task.
  std::uint64_t on_chain = 0;
  double bytes = 0;
  double particles = 0;

  void add(const TaskTotals& other);
};

/// A task with what it took on each patch; one number where it does not work on patches.
struct TaskRow {
  std::string name;
  /// What its tasks are for, in a trace.
  std::string category{};
  bool over_patches = false;
  TaskTotals totals;
  std::vector<std::uint64_t> per_patch;

  void add(const TaskRow& other);
};

/// What turns the numbers of rows into those of a profile.
struct RowScales {
  /// Of all tasks together.
  std::uint64_t all_ticks = 0;
  double second_per_tick = 0;
  /// The number of all steps over those that are looked at, and over those with processor time; and the time of all
  /// over that of those which are looked at.
  double steps = 0;
  double processor_steps = 0;
  double time = 0;
  /// Steps that were looked at, by all ranks in sum.
  double looked_at = 0;
  /// The rank whose rows they are, of which only the patches count; -1 for all ranks.
  int rank = -1;
};

/// Has `look` see the rows of each rank in turn: they are the same on all, as the graph is, and only their numbers
/// travel. Collective.
void for_each_rank(const std::vector<TaskRow>& own, const Communicator& communicator,
                   const std::function<void(int rank, const std::vector<TaskRow>& rows)>& look);

std::uint64_t ticks_of(const std::vector<TaskRow>& rows);

/// Of all tasks that had something to do, most expensive first. `rank_of_patch` is that of the end.
std::vector<TaskStatistics> statistics(const std::vector<TaskRow>& rows, const RowScales& scales,
                                       const std::vector<int>& rank_of_patch);

/// What all tasks took on each patch [s], and which took most.
std::vector<PatchStatistics> patch_statistics(const std::vector<TaskRow>& rows, const std::vector<int>& ranks,
                                              double second_per_tick);

}  // namespace tamp::runtime
