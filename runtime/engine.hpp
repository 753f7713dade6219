#pragma once

#include <cstddef>
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

/// The runtime's front door: graphs over the patches of one layout, with their data, ready to run on threads and ranks.
/// docs/first_task_graph.md is a tour. The first graph is the step, which makes the state that the next one reads; the
/// others read that state too, and make results.
class Engine
{
 public:
  /// `n_workers` is the number of threads of the executors that will run it. Throws GraphError with every mistake that
  /// the tasks hold. Collective.
  Engine(const PatchLayout& layout, const std::vector<std::string>& group_names, std::vector<GraphTasks> graphs,
         int n_workers, const Communicator& communicator = {});
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Runs the first graph and makes what it computed the state. What a task throws comes out as TaskError; the state is
  /// then still that of before, unless particles migrate without waiting for a check. After the failure of another
  /// rank, which is thrown as it is, the engine cannot advance any more.
  void advance(Executor& executor, const Step& step);

  const PatchLayout& layout() const { return layout_; }
  /// The state and the results, for the host between steps.
  Warehouse& warehouse() { return warehouse_; }
  const Warehouse& warehouse() const { return warehouse_; }

  const TaskGraph& graph(std::size_t i = 0) const { return graphs_[i]; }
  BoundGraph& bound(std::size_t i = 0) { return bound_[i]; }
  Schedule& schedule(std::size_t i = 0) { return schedules_[i]; }

 private:
  const PatchLayout layout_;
  std::deque<TaskGraph> graphs_;
  Warehouse warehouse_;
  std::deque<BoundGraph> bound_;
  std::deque<Schedule> schedules_;
};

}  // namespace tamp::runtime
