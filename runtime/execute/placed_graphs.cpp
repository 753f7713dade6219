#include "runtime/execute/placed_graphs.hpp"

namespace tamp::runtime
{

namespace
{

std::deque<TaskGraph> compiled(const std::vector<GraphTasks>& graphs, const PatchLayout& layout,
                               const std::vector<std::string>& group_names)
{
  std::deque<TaskGraph> all;
  for (const GraphTasks& graph : graphs) all.emplace_back(graph.tasks, layout, group_names, graph.host);
  return all;
}

std::vector<const TaskGraph*> pointers_to(const std::deque<TaskGraph>& graphs)
{
  std::vector<const TaskGraph*> all;
  all.reserve(graphs.size());
  for (const TaskGraph& graph : graphs) all.push_back(&graph);
  return all;
}

}  // namespace

PlacedGraphs::PlacedGraphs(const PatchLayout& given_layout, const std::vector<std::string>& group_names,
                           const std::vector<GraphTasks>& tasks, int n_workers, const Communicator& communicator)
    : layout(given_layout),
      graphs(compiled(tasks, layout, group_names)),
      warehouse(pointers_to(graphs), communicator.rank())
{
  for (const TaskGraph& graph : graphs) {
    bound.emplace_back(graph, warehouse, communicator);
    schedules.emplace_back(bound.back(), n_workers);
  }
}

}  // namespace tamp::runtime
