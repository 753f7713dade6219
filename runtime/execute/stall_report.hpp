#pragma once

#include <string>
#include <vector>

#include "runtime/execute/scheduler/schedule_state.hpp"

namespace tamp::runtime
{

struct RunningInstance {
  int instance;
  int worker;
  /// How long it has been running [s].
  double time;
};

/// Says of a step that goes on what runs, and what is blocked by which missing predecessors: first what waits for one
/// that runs or for another rank, as the rest waits for these. About 20 lines at most.
std::string stall_report(const ScheduleState& schedule, const std::vector<RunningInstance>& running, double idle_time);

}  // namespace tamp::runtime
