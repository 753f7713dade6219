#include "tools/bench/tasks_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

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

nlohmann::ordered_json json_of(const TaskRow& row)
{
  return {{"scheduler", row.scheduler},
          {"pattern", row.pattern},
          {"ranks", row.ranks},
          {"threads", row.threads},
          {"message_bytes", row.message_bytes},
          {"overhead_ns", median_of(row.overhead_ns)},
          {"overhead_min_ns", least_of(row.overhead_ns)},
          {"metg50_us", median_of(row.metg50_us)},
          {"metg50_min_us", least_of(row.metg50_us)},
          {"processor_ns", median_of(row.processor_ns)},
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
  return fmt::format("  {:<23}{:>5}{:>9}  {:<30}{:>9}{:>9}{:>10}{:>9}{:>9}{:>11}{:>11}\n",
                     row["pattern"].get<std::string>(), row["ranks"].get<int>(), row["threads"].get<int>(),
                     row["scheduler"].get<std::string>(), cell(row["overhead_min_ns"], 1), cell(row["overhead_ns"], 1),
                     cell(row["metg50_min_us"], 3), cell(row["metg50_us"], 3), cell(row["processor_ns"], 1),
                     cell(row["calibration_ns"], 2), row["discarded"].get<int>());
}

}  // namespace

void TaskRow::add(const TaskFigures& figures)
{
  if (figures.overhead) overhead_ns.push_back(*figures.overhead);
  if (figures.overhead) calibration_ns.push_back(figures.calibration);
  if (figures.processor) processor_ns.push_back(*figures.processor);
  if (figures.metg50) metg50_us.push_back(*figures.metg50 * 1e-3);
  n_discarded += figures.n_discarded;
}

Result task_table(const std::string& title, const std::vector<TaskRow>& rows)
{
  Result result;
  result.json = nlohmann::ordered_json::array();
  result.text = fmt::format("{}\n  {:<23}{:>5}{:>9}  {:<30}{:>9}{:>9}{:>10}{:>9}{:>9}{:>11}{:>11}\n", title, "pattern",
                            "ranks", "threads", "scheduler", "least ns", "median", "least us", "median", "cpu ns",
                            "kernel ns", "discarded");
  for (const TaskRow& row : rows) {
    result.json.push_back(json_of(row));
    result.text += text_of(result.json.back());
  }
  return result;
}

}  // namespace tamp::tools::bench
