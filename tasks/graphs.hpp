#pragma once

#include <vector>

#include "runtime/engine.hpp"
#include "tasks/report/report.hpp"
#include "tasks/report/sample_contact.hpp"
#include "tasks/report/sample_state.hpp"
#include "tasks/time_step.hpp"

namespace tamp::tasks
{

/// Places of the graphs of a scene in its engine.
constexpr std::size_t step_graph = 0, report_graph = 1, sample_graph = 2, contact_graph = 3;

/// The graphs of a step, of a report and of what monitors sample, of the state and of the contact.
template <int D>
std::vector<runtime::GraphTasks> graphs_of(const Method<D>& method)
{
  const runtime::HostData host = host_data(method);
  return {{time_step(method), host},
          {report_tasks(method), {host.state, {&particle_report, &nose_report}}},
          {sample_tasks(method), sample_data(method)},
          {contact_sample_tasks(method), contact_sample_data(method)}};
}

}  // namespace tamp::tasks
