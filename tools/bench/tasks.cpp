#include <fmt/format.h>

#include <chrono>

#include "tools/bench/bench.hpp"
#include "tools/bench/tasks_measurement.hpp"
#include "tools/bench/tasks_ranks.hpp"
#include "tools/bench/tasks_table.hpp"

namespace tamp::tools::bench
{

namespace
{

std::vector<TaskContest> contests_of(const TaskOptions& options)
{
  std::vector<TaskContest> contests;
  for (const TaskPattern& pattern :
       {stencil_pattern(32, 10), nearest_27_pattern(4, 10), fft_pattern(32, 10), tree_pattern(32, 10)}) {
    for (const int n_threads : options.n_threads) {
      for (const TaskContestant& contestant : task_contestants()) {
        if (contestant.can_run(pattern, n_threads)) contests.push_back({contestant, pattern, n_threads});
      }
    }
  }
  return contests;
}

}  // namespace

Result tasks(const TaskOptions& options)
{
  const auto ranks = runtime::Communicator::world();
  if (ranks.size() > 1) return rank_tasks(options, ranks);
  const std::vector<TaskContest> contests = contests_of(options);
  std::vector<TaskRow> rows;
  rows.reserve(contests.size());
  for (const TaskContest& c : contests) rows.push_back({c.contestant.name, c.pattern.name, 1, c.n_threads});
  const auto start = std::chrono::steady_clock::now();
  int n_rounds = 0;
  while (n_rounds < options.n_rounds && std::chrono::steady_clock::now() - start < options.patience) {
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].add(measure_tasks(contests[k]));
    ++n_rounds;
  }
  Result result =
      task_table(fmt::format("tasks: time of all threads per task with an empty body, and METG(50 %), minimum "
                             "and median of {} rounds; processor time of empty tasks (cpu ns), median",
                             n_rounds),
                 rows);
  if (!openmp_contestant()) result.text += "  OpenMP was not found when TAMP was built, and is left out.\n";
  return result;
}

}  // namespace tamp::tools::bench
