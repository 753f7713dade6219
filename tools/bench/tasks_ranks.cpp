#include "tools/bench/tasks_ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <stdexcept>

#include "tools/bench/tasks_kernel.hpp"
#include "tools/bench/tasks_measurement.hpp"
#include "tools/bench/tasks_ranks_contestants.hpp"
#include "tools/bench/tasks_table.hpp"

namespace tamp::tools::bench
{

namespace
{

using Clock = std::chrono::steady_clock;

/// Time per step of the slowest rank, so that all ranks come to the same decisions.
double step_ns(RowScheduler& scheduler, int n_steps, const runtime::Communicator& ranks)
{
  ranks.barrier();
  const auto start = Clock::now();
  scheduler.run(n_steps);
  const double own = std::chrono::duration<double, std::nano>(Clock::now() - start).count() / n_steps;
  return ranks.max(own);
}

/// The mean over ranks that all run it at the same time.
double kernel_ns_on(const runtime::Communicator& ranks)
{
  ranks.barrier();
  const std::vector<double> all = ranks.gather_value(kernel_ns(1));
  return std::accumulate(all.begin(), all.end(), 0.0) / ranks.size();
}

/// A contestant on one row of patches.
struct RowContest {
  RowContestant contestant;
  PatchRow shape;
};

double granularity(const RowContest& contest, int kernel_iterations, const runtime::Communicator& ranks)
{
  StampedRow row(contest.shape);
  row.kernel_iterations = kernel_iterations;
  const auto scheduler = contest.contestant.make(row, ranks);
  const double ns = steady_run_ns([&](int n_steps) { return step_ns(*scheduler, n_steps, ranks); });
  for (const std::string& fault : ranks.gather(row.fault())) {
    if (!fault.empty()) throw std::logic_error(contest.contestant.name + ": " + fault);
  }
  return ns / contest.shape.patches_per_rank;
}

TaskFigures measure(const RowContest& contest, const runtime::Communicator& ranks)
{
  return measure_tasks(
      TaskSubject{[&](int kernel_iterations) { return granularity(contest, kernel_iterations, ranks); },
                  [&] { return kernel_ns_on(ranks); }});
}

}  // namespace

Result rank_tasks(const TaskOptions& options, const runtime::Communicator& ranks)
{
  const int n_values = options.message_bytes / static_cast<int>(sizeof(std::uint64_t));
  std::vector<RowContest> contests;
  std::vector<TaskRow> rows;
  for (const int n : {1, 4}) {
    for (const RowContestant& contestant : {tamp_row_contestant(), plain_mpi_row_contestant()}) {
      contests.push_back({contestant, {ranks.size(), n, n_values}});
      rows.push_back({contestant.name, fmt::format("row, {} a rank", n), ranks.size(), 1, options.message_bytes});
    }
  }
  const auto start = Clock::now();
  int n_rounds = 0;
  while (n_rounds < options.n_rounds && ranks.from_first(Clock::now() - start) < options.patience) {
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].add(measure(contests[k], ranks));
    ++n_rounds;
  }
  return task_table(fmt::format("tasks on {} ranks, messages of {} bytes: time of all ranks per task with an empty "
                                "body, and METG(50 %); minimum and median of {} rounds",
                                ranks.size(), options.message_bytes, n_rounds),
                    rows);
}

}  // namespace tamp::tools::bench
