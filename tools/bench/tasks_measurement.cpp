#include "tools/bench/tasks_measurement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tools/bench/statistics.hpp"
#include "tools/bench/tasks_kernel.hpp"

namespace tamp::tools::bench
{

namespace
{

constexpr int n_batches = 5;
constexpr double batch_ns = 1e6;
constexpr int most_attempts = 5;
constexpr double longest_kernel_ns = 1e5;

double run_ns(TaskScheduler& scheduler, int n_runs)
{
  const auto start = std::chrono::steady_clock::now();
  scheduler.run(n_runs);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / n_runs;
}

/// Time of all threads per task [ns], the median of a few batches of runs.
double granularity(const TaskContest& contest, int kernel_iterations)
{
  StampedTasks tasks(contest.pattern);
  tasks.kernel_iterations = kernel_iterations;
  const auto scheduler = contest.contestant.make(tasks, contest.n_threads);
  scheduler->run(1);
  const int n_runs = std::max(1, static_cast<int>(batch_ns / run_ns(*scheduler, 1)));
  std::vector<double> ns(n_batches);
  for (double& of_batch : ns) of_batch = run_ns(*scheduler, n_runs);
  if (const std::string fault = tasks.fault(); !fault.empty()) {
    throw std::logic_error(contest.contestant.name + ": " + fault);
  }
  return median(std::move(ns)) * contest.n_threads / tasks.size();
}

/// One length of task, measured until the calibrations on both sides agree.
std::optional<TaskSample> sample(const TaskContest& contest, int kernel_iterations, TaskFigures& figures)
{
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const double before = kernel_ns(contest.n_threads);
    const double ns = granularity(contest, kernel_iterations);
    const double after = kernel_ns(contest.n_threads);
    if (std::abs(after - before) <= most_drift * std::min(before, after)) {
      figures.calibration = (before + after) / 2;
      return TaskSample{ns, kernel_iterations * figures.calibration};
    }
    ++figures.n_discarded;
  }
  return std::nullopt;
}

/// From tasks an eighth as long as their overhead, each time twice as long, until half of the time is work.
std::optional<double> sweep(const TaskContest& contest, TaskFigures& figures)
{
  std::vector<TaskSample> samples;
  int iterations = std::max(1, static_cast<int>(figures.overhead.value() / 8 / figures.calibration));
  while (iterations * figures.calibration < longest_kernel_ns) {
    const auto next = sample(contest, iterations, figures);
    if (!next) return std::nullopt;
    samples.push_back(*next);
    if (next->efficiency() > 0.5) break;
    iterations *= 2;
  }
  return metg50(samples);
}

}  // namespace

TaskFigures measure_tasks(const TaskContest& contest)
{
  TaskFigures figures;
  if (const auto empty = sample(contest, 0, figures)) {
    figures.overhead = empty->granularity;
    figures.metg50 = sweep(contest, figures);
  }
  return figures;
}

}  // namespace tamp::tools::bench
