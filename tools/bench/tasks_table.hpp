#pragma once

#include <string>
#include <vector>

#include "tools/bench/bench.hpp"
#include "tools/bench/tasks_measurement.hpp"

namespace tamp::tools::bench
{

/// The results of one scheduler on one pattern, by round.
struct TaskRow {
  std::string scheduler;
  std::string pattern;
  int ranks = 1;
  /// Threads of each rank.
  int threads = 1;
  /// Data of a message from rank to rank; 0 where there are none.
  int message_bytes = 0;
  std::vector<double> overhead_ns{}, metg50_us{}, processor_ns{}, calibration_ns{};
  int n_discarded = 0;

  void add(const TaskFigures& figures);
};

Result task_table(const std::string& title, const std::vector<TaskRow>& rows);

}  // namespace tamp::tools::bench
