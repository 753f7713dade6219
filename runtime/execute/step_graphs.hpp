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

/// Graphs over patches that are dealt to ranks.
struct CompiledGraphs {
  /// Throws GraphError with every mistake that the tasks hold.
  CompiledGraphs(const PatchLayout& layout, const std::vector<std::string>& group_names,
                 const std::vector<GraphTasks>& tasks);
  CompiledGraphs(const CompiledGraphs&) = delete;
  CompiledGraphs& operator=(const CompiledGraphs&) = delete;

  std::vector<const TaskGraph*> pointers() const;

  const PatchLayout layout;
  std::deque<TaskGraph> graphs;
};

/// Compiled graphs tied to their data, ready to run.
struct ReadyGraphs {
  /// `n_workers` is the number of threads of the executor that will run them. Collective.
  ReadyGraphs(const CompiledGraphs& compiled, Warehouse& warehouse, int n_workers, const Communicator& communicator,
              const RankClocks& clocks);
  ReadyGraphs(const ReadyGraphs&) = delete;
  ReadyGraphs& operator=(const ReadyGraphs&) = delete;

  std::deque<BoundGraph> bound;
  std::deque<Schedule> schedules;
};

}  // namespace tamp::runtime
