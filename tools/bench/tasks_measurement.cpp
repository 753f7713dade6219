#include "tools/bench/tasks_measurement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tools/bench/tasks_kernel.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

constexpr int n_batches = 5;
constexpr double batch_ns = 1e6;
constexpr int most_attempts = 5;
constexpr double longest_kernel_ns = 1e5;

double granularity(const TaskContest& contest, int kernel_iterations)
{
  StampedTasks tasks(contest.pattern);
  tasks.kernel_iterations = kernel_iterations;
  const auto scheduler = contest.contestant.make(tasks, contest.n_threads);
  const double ns = steady_run_ns([&](int n_runs) {
    const auto start = std::chrono::steady_clock::now();
    scheduler->run(n_runs);
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / n_runs;
  });
  if (const std::string fault = tasks.fault(); !fault.empty()) {
    throw std::logic_error(contest.contestant.name + ": " + fault);
  }
  return ns * contest.n_threads / tasks.size();
}

/// One length of task, measured until the calibrations on both sides agree.
std::optional<TaskSample> sample(const TaskSubject& subject, int kernel_iterations, TaskFigures& figures)
{
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const double before = subject.kernel_ns();
    const double ns = subject.granularity(kernel_iterations);
    const double after = subject.kernel_ns();
    if (std::abs(after - before) <= most_drift * std::min(before, after)) {
      figures.calibration = (before + after) / 2;
      return TaskSample{ns, kernel_iterations * figures.calibration};
    }
    ++figures.n_discarded;
  }
  return std::nullopt;
}

/// From tasks an eighth as long as their overhead, each time twice as long, until half of the time is work.
std::optional<double> sweep(const TaskSubject& subject, TaskFigures& figures)
{
  std::vector<TaskSample> samples;
  int iterations = std::max(1, static_cast<int>(figures.overhead.value() / 8 / figures.calibration));
  while (iterations * figures.calibration < longest_kernel_ns) {
    const auto next = sample(subject, iterations, figures);
    if (!next) return std::nullopt;
    samples.push_back(*next);
    if (next->efficiency() > 0.5) break;
    iterations *= 2;
  }
  return metg50(samples);
}

}  // namespace

double steady_run_ns(const std::function<double(int n_runs)>& run_ns)
{
  run_ns(1);
  const int n_runs = std::max(1, static_cast<int>(batch_ns / run_ns(1)));
  std::vector<double> ns(n_batches);
  for (double& of_batch : ns) of_batch = run_ns(n_runs);
  return median(std::move(ns));
}

TaskFigures measure_tasks(const TaskSubject& subject)
{
  TaskFigures figures;
  if (const auto empty = sample(subject, 0, figures)) {
    figures.overhead = empty->granularity;
    figures.metg50 = sweep(subject, figures);
  }
  return figures;
}

TaskFigures measure_tasks(const TaskContest& contest)
{
  return measure_tasks(TaskSubject{[&](int kernel_iterations) { return granularity(contest, kernel_iterations); },
                                   [&] { return kernel_ns(contest.n_threads); }});
}

}  // namespace tamp::tools::bench
