#pragma once

#include <deque>
#include <string>
#include <vector>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/graph/task_graph.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// The tasks of a graph, and what its host gives and takes.
struct GraphTasks {
  std::vector<TaskDeclaration> tasks;
  HostData host;
};

/// Graphs over patches that are dealt to ranks, with their data, ready to run.
struct PlacedGraphs {
  /// `n_workers` is the number of threads of the executor that will run them. Throws GraphError with every mistake that
  /// the tasks hold. Collective.
  PlacedGraphs(const PatchLayout& layout, const std::vector<std::string>& group_names,
               const std::vector<GraphTasks>& tasks, int n_workers, const Communicator& communicator);
  PlacedGraphs(const PlacedGraphs&) = delete;
  PlacedGraphs& operator=(const PlacedGraphs&) = delete;

  const PatchLayout layout;
  std::deque<TaskGraph> graphs;
  Warehouse warehouse;
  std::deque<BoundGraph> bound;
  std::deque<Schedule> schedules;
};

}  // namespace tamp::runtime
