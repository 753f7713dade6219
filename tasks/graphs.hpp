#pragma once

#include <vector>

#include "runtime/engine.hpp"
#include "tasks/report/report.hpp"
#include "tasks/time_step.hpp"

namespace tamp::tasks
{

/// Places of the graphs of a scene in its engine.
constexpr std::size_t step_graph = 0, report_graph = 1;

/// The graphs of a step and of a report.
template <int D>
std::vector<runtime::GraphTasks> graphs_of(const Method<D>& method)
{
  const runtime::HostData host = host_data(method);
  return {{time_step(method), host}, {report_tasks(method), {host.state, {&particle_report, &nose_report}}}};
}

}  // namespace tamp::tasks
