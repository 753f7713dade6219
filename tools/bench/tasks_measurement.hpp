#pragma once

#include <functional>
#include <optional>

#include "tools/bench/tasks_metg.hpp"
#include "tools/bench/tasks_pattern.hpp"
#include "tools/bench/tasks_schedulers.hpp"

namespace tamp::tools::bench
{

/// Who is measured, and on what.
struct TaskContest {
  TaskContestant contestant;
  TaskPattern pattern;
  int n_threads = 1;
};

/// Result of one round. Absent where the processor's speed did not hold still for long enough.
struct TaskFigures {
  /// Cost of a task with an empty body [ns], threads times time.
  std::optional<double> overhead;
  std::optional<double> metg50;
  /// Processor time of all threads per task with an empty body [ns]: what others take of the cores is not in it, nor is
  /// waiting asleep.
  std::optional<double> processor;
  /// Time of the kernel per iteration [ns].
  double calibration = 0;
  /// Measurements thrown away because the calibrations before and after differed by more than `most_drift`.
  int n_discarded = 0;
};

/// Cores of a virtual machine may turn into siblings of one core and back at any time.
constexpr double most_drift = 0.1;

/// Tasks whose length can be set.
struct TaskSubject {
  /// Time of all cores per task [ns] with so many iterations of the kernel in each.
  std::function<double(int kernel_iterations)> granularity;
  /// Time of the kernel per iteration, alone and on all these cores at once [ns].
  std::function<double()> kernel_ns;
  /// Processor time per task [ns] with an empty body; may be left out.
  std::function<double()> processor_ns{};
};

TaskFigures measure_tasks(const TaskSubject& subject);
/// Throws std::logic_error if the contestant runs a task before what it reads.
TaskFigures measure_tasks(const TaskContest& contest);

/// The median time of a run [ns] in batches of runs, where `run_ns(n_runs)` gives the time of each of so many.
double steady_run_ns(const std::function<double(int n_runs)>& run_ns);

}  // namespace tamp::tools::bench
