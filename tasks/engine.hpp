#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/schedule.hpp"
#include "runtime/ranks/communicator.hpp"
#include "tasks/labels.hpp"
#include "tasks/method.hpp"
#include "tasks/report.hpp"
#include "tasks/time_step.hpp"

namespace tamp::tasks
{

/// What runs a scene on one dealing of its patches to ranks: the graphs of a step and of a report, and their data.
template <int D>
class Engine
{
 public:
  /// A step that is not `accepted` leaves the state before it whole. Collective.
  Engine(const Method<D>& method, const std::vector<std::string>& material_names, const runtime::PatchLayout& dealt,
         const runtime::Communicator& communicator, int n_workers, std::function<bool(const StepTotals&)> accepted)
      : layout(dealt),
        step_graph(time_step(method, std::move(accepted)), layout, material_names, host_data(method)),
        report_graph(report_tasks(method), layout, material_names,
                     {host_data(method).state, {&particle_report, &nose_report}}),
        warehouse(std::array<const runtime::TaskGraph*, 2>{&step_graph, &report_graph}, communicator.rank()),
        step(step_graph, warehouse, communicator),
        report(report_graph, warehouse, communicator),
        step_schedule(step, n_workers),
        report_schedule(report, n_workers)
  {
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const runtime::PatchLayout layout;
  runtime::TaskGraph step_graph;
  runtime::TaskGraph report_graph;
  runtime::Warehouse warehouse;
  runtime::BoundGraph step;
  runtime::BoundGraph report;
  runtime::Schedule step_schedule;
  runtime::Schedule report_schedule;
};

}  // namespace tamp::tasks
