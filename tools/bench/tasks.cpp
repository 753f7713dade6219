#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "tools/bench/bench.hpp"
#include "tools/bench/statistics.hpp"
#include "tools/bench/tasks_measurement.hpp"

namespace tamp::tools::bench
{

namespace
{

/// A contest with what its rounds found.
struct Row {
  TaskContest contest;
  std::vector<double> overhead_ns{}, metg50_us{}, calibration_ns{};
  int n_discarded = 0;

  void add(const TaskFigures& figures)
  {
    if (figures.overhead) overhead_ns.push_back(*figures.overhead);
    if (figures.overhead) calibration_ns.push_back(figures.calibration);
    if (figures.metg50) metg50_us.push_back(*figures.metg50 * 1e-3);
    n_discarded += figures.n_discarded;
  }
};

std::vector<Row> rows_of(const TaskOptions& options)
{
  std::vector<Row> rows;
  for (const TaskPattern& pattern : {stencil_pattern(32, 10), nearest_27_pattern(4, 10)}) {
    for (const int n_threads : options.n_threads) {
      for (const TaskContestant& contestant : task_contestants()) {
        if (n_threads == 1 || !contestant.one_thread_only) rows.push_back({{contestant, pattern, n_threads}});
      }
    }
  }
  return rows;
}

/// Null where no round gave a figure.
nlohmann::ordered_json least_of(const std::vector<double>& values)
{
  if (values.empty()) return nullptr;
  return *std::min_element(values.begin(), values.end());
}

nlohmann::ordered_json median_of(const std::vector<double>& values)
{
  if (values.empty()) return nullptr;
  return median(values);
}

nlohmann::ordered_json json_of(const Row& row)
{
  return {{"scheduler", row.contest.contestant.name},
          {"pattern", row.contest.pattern.name},
          {"threads", row.contest.n_threads},
          {"overhead_ns", median_of(row.overhead_ns)},
          {"overhead_min_ns", least_of(row.overhead_ns)},
          {"metg50_us", median_of(row.metg50_us)},
          {"metg50_min_us", least_of(row.metg50_us)},
          {"calibration_ns", median_of(row.calibration_ns)},
          {"rounds", row.overhead_ns.size()},
          {"discarded", row.n_discarded}};
}

std::string cell(const nlohmann::ordered_json& value, int decimals)
{
  return value.is_null() ? "-" : fmt::format("{:.{}f}", value.get<double>(), decimals);
}

std::string text_of(const nlohmann::ordered_json& row)
{
  return fmt::format("  {:<12}{:>7}  {:<30}{:>9}{:>9}{:>10}{:>9}{:>13}{:>11}\n", row["pattern"].get<std::string>(),
                     row["threads"].get<int>(), row["scheduler"].get<std::string>(), cell(row["overhead_min_ns"], 1),
                     cell(row["overhead_ns"], 1), cell(row["metg50_min_us"], 3), cell(row["metg50_us"], 3),
                     cell(row["calibration_ns"], 2), row["discarded"].get<int>());
}

Result result_of(const std::vector<Row>& rows, int n_rounds)
{
  Result result;
  result.json = nlohmann::ordered_json::array();
  result.text = fmt::format(
      "tasks: time of all threads per task with an empty body, and METG(50 %); minimum and median of {} rounds\n"
      "  {:<12}{:>7}  {:<30}{:>9}{:>9}{:>10}{:>9}{:>13}{:>11}\n",
      n_rounds, "pattern", "threads", "scheduler", "least ns", "median", "least us", "median", "kernel ns",
      "discarded");
  for (const Row& row : rows) {
    result.json.push_back(json_of(row));
    result.text += text_of(result.json.back());
  }
  if (!openmp_contestant()) result.text += "  OpenMP was not found when TAMP was built, and is left out.\n";
  return result;
}

}  // namespace

Result tasks(const TaskOptions& options)
{
  std::vector<Row> rows = rows_of(options);
  const auto start = std::chrono::steady_clock::now();
  int n_rounds = 0;
  while (n_rounds < options.n_rounds && std::chrono::steady_clock::now() - start < options.patience) {
    for (Row& row : rows) row.add(measure_tasks(row.contest));
    ++n_rounds;
  }
  return result_of(rows, n_rounds);
}

}  // namespace tamp::tools::bench
