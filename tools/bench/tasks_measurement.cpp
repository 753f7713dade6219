#include "tools/bench/tasks_measurement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tools/bench/tasks_kernel.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

constexpr int n_batches = 5;
constexpr double batch_ns = 1e6;
constexpr int most_attempts = 5;
constexpr double longest_kernel_ns = 1e5;
/// The time of threads that go on running is booked by the tick, of some milliseconds: only a long batch has it all.
constexpr auto processor_batch = std::chrono::milliseconds(60);

void expect_no_fault(const TaskContest& contest, const StampedTasks& tasks)
{
  if (const std::string fault = tasks.fault(); !fault.empty()) {
    throw std::logic_error(contest.contestant.name + ": " + fault);
  }
}

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
  expect_no_fault(contest, tasks);
  return ns * contest.n_threads / tasks.size();
}

double processor_ns(const TaskContest& contest)
{
  constexpr int runs_in_a_row = 20;
  StampedTasks tasks(contest.pattern);
  const auto scheduler = contest.contestant.make(tasks, contest.n_threads);
  scheduler->run(runs_in_a_row);
  const auto start = std::chrono::steady_clock::now();
  const double before = process_seconds();
  long n_runs = 0;
  for (; std::chrono::steady_clock::now() - start < processor_batch; n_runs += runs_in_a_row) {
    scheduler->run(runs_in_a_row);
  }
  const double seconds = process_seconds() - before;
  expect_no_fault(contest, tasks);
  return seconds * 1e9 / static_cast<double>(n_runs) / tasks.size();
}

/// Measures tasks of one length, until the calibrations before and after agree.
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

/// Measures tasks from an eighth of their overhead on, each time twice as long, until half of the time is work.
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
  if (subject.processor_ns) figures.processor = subject.processor_ns();
  if (const auto empty = sample(subject, 0, figures)) {
    figures.overhead = empty->granularity;
    figures.metg50 = sweep(subject, figures);
  }
  return figures;
}

TaskFigures measure_tasks(const TaskContest& contest)
{
  return measure_tasks(TaskSubject{[&](int kernel_iterations) { return granularity(contest, kernel_iterations); },
                                   [&] { return kernel_ns(contest.n_threads); },
                                   [&] { return processor_ns(contest); }});
}

}  // namespace tamp::tools::bench
