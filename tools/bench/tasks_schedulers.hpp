#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/tasks_graph.hpp"

namespace tamp::tools::bench
{

/// Something that runs tasks in an order that they allow, made for one set of tasks.
class TaskScheduler
{
 public:
  virtual ~TaskScheduler() = default;
  /// Runs all tasks `n_runs` times, each run after the one before.
  virtual void run(int n_runs) = 0;
};

/// A contestant of the comparison.
struct TaskContestant {
  std::string name;
  std::unique_ptr<TaskScheduler> (*make)(StampedTasks& tasks, int n_threads);
  bool one_thread_only = false;
  /// It can run patterns with a shape in space.
  bool reads_neighbours_only = false;

  bool can_run(const TaskPattern& pattern, int n_threads) const
  {
    return (n_threads == 1 || !one_thread_only) && (pattern.shape || !reads_neighbours_only);
  }
};

/// TAMP's own executor, which records when and where each task ran as it does in every run.
TaskContestant tamp_contestant();
/// The same as tasks of an engine, declared with labels and halos on patches of one cell, as those of a simulation are:
/// with the engine's work for each step, and the copies into halos.
TaskContestant declared_contestant();

/// Task after task on one thread: no scheduler at all.
TaskContestant loop_contestant();
/// A team of threads, each with the same points in every step, that wait for each other after each step: the floor for
/// several threads, as nothing is decided at run time.
TaskContestant barrier_contestant();

/// oneTBB: a parallel loop over the points of each step, dealt out evenly.
TaskContestant parallel_for_contestant();
/// oneTBB: a flow graph of continue_nodes, built once.
TaskContestant flow_graph_contestant();
/// The same with the policy `lightweight`: a node runs at once, within the one that completes what it waits for.
TaskContestant lightweight_flow_graph_contestant();
/// oneTBB: tasks with counters of what they wait for; whoever completes one goes on with the first that it freed.
TaskContestant task_group_contestant();

/// OpenMP tasks with depend, created anew in every run: OpenMP keeps no graph until its `taskgraph`, which gcc 12 has
/// not. None where TAMP was built without OpenMP.
std::optional<TaskContestant> openmp_contestant();

/// All of the above contestants that are available, ours first.
std::vector<TaskContestant> task_contestants();

}  // namespace tamp::tools::bench
