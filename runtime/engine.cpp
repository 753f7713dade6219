#include "runtime/engine.hpp"

#include <utility>

namespace tamp::runtime
{

namespace
{

std::deque<TaskGraph> compiled(std::vector<GraphTasks> graphs, const PatchLayout& layout,
                               const std::vector<std::string>& group_names)
{
  std::deque<TaskGraph> all;
  for (GraphTasks& graph : graphs) all.emplace_back(std::move(graph.tasks), layout, group_names, graph.host);
  return all;
}

std::vector<const TaskGraph*> pointers_to(const std::deque<TaskGraph>& graphs)
{
  std::vector<const TaskGraph*> all;
  for (const TaskGraph& graph : graphs) all.push_back(&graph);
  return all;
}

}  // namespace

Engine::Engine(const PatchLayout& layout, const std::vector<std::string>& group_names, std::vector<GraphTasks> graphs,
               int n_workers, const Communicator& communicator)
    : layout_(layout),
      graphs_(compiled(std::move(graphs), layout_, group_names)),
      warehouse_(pointers_to(graphs_), communicator.rank())
{
  for (const TaskGraph& graph : graphs_) {
    bound_.emplace_back(graph, warehouse_, communicator);
    schedules_.emplace_back(bound_.back(), n_workers);
  }
}

void Engine::advance(Executor& executor, const Step& step)
{
  executor.run(schedules_.front(), step);
  warehouse_.advance();
}

}  // namespace tamp::runtime
