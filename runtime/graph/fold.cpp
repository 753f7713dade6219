#include "runtime/graph/fold.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace tamp::runtime
{

namespace
{

void fold_tasks(const TaskGraph& graph, FoldedGraph& folded)
{
  std::map<std::string, int> numbers;
  for (const Instance& instance : graph.instances()) {
    const auto [found, fresh] = numbers.try_emplace(graph.name(instance), static_cast<int>(folded.tasks.size()));
    if (fresh) folded.tasks.push_back({found->first, instance.kind, {}, {}});
    FoldedTask& task = folded.tasks[static_cast<std::size_t>(found->second)];
    task.instances.push_back(static_cast<int>(folded.task_of.size()));
    if (instance.group >= 0) task.groups.push_back(instance.group);
    folded.task_of.push_back(found->second);
  }
  for (FoldedTask& task : folded.tasks) {
    std::sort(task.groups.begin(), task.groups.end());
    task.groups.erase(std::unique(task.groups.begin(), task.groups.end()), task.groups.end());
  }
}

void add(const Edge& e, bool crosses, FoldedLabel& sum)
{
  sum.label = e.label;
  sum.halo = std::max(sum.halo, e.halo);
  sum.bytes += e.bytes;
  ++sum.n_edges;
  sum.n_crossing += std::size_t{crosses};
}

}  // namespace

bool FoldedEdge::crosses() const
{
  return std::any_of(labels.begin(), labels.end(), [](const FoldedLabel& l) { return l.n_crossing > 0; });
}

FoldedGraph fold(const TaskGraph& graph)
{
  FoldedGraph folded;
  fold_tasks(graph, folded);
  std::map<std::pair<int, int>, std::map<std::string, FoldedLabel>> sums;
  for (const Edge& e : graph.edges()) {
    const auto from = static_cast<std::size_t>(e.from), to = static_cast<std::size_t>(e.to);
    const bool crosses = graph.instances()[from].rank != graph.instances()[to].rank;
    add(e, crosses, sums[{folded.task_of[from], folded.task_of[to]}][e.label->name()]);
  }
  for (const auto& [ends, labels] : sums) {
    FoldedEdge& edge = folded.edges.emplace_back(FoldedEdge{ends.first, ends.second, {}});
    for (const auto& [name, label] : labels) edge.labels.push_back(label);
  }
  return folded;
}

}  // namespace tamp::runtime
