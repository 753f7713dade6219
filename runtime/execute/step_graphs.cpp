#include "runtime/execute/step_graphs.hpp"

namespace tamp::runtime
{

CompiledGraphs::CompiledGraphs(const PatchLayout& given_layout, const std::vector<std::string>& group_names,
                               const std::vector<GraphTasks>& tasks)
    : layout(given_layout)
{
  for (const GraphTasks& graph : tasks) {
    graphs.emplace_back(graph.tasks, layout, group_names, graph.host).drop_edges();
  }
}

std::vector<const TaskGraph*> CompiledGraphs::pointers() const
{
  std::vector<const TaskGraph*> all;
  all.reserve(graphs.size());
  for (const TaskGraph& graph : graphs) all.push_back(&graph);
  return all;
}

ReadyGraphs::ReadyGraphs(const CompiledGraphs& compiled, Warehouse& warehouse, int n_workers,
                         const Communicator& communicator, const RankClocks& clocks)
{
  for (const TaskGraph& graph : compiled.graphs) {
    bound.emplace_back(graph, warehouse, communicator, &clocks);
    schedules.emplace_back(bound.back(), n_workers);
  }
}

}  // namespace tamp::runtime
