#include "runtime/execute/schedule.hpp"

#include <algorithm>

namespace tamp::runtime
{

Schedule::Schedule(BoundGraph& graph, int n_workers)
    : graph_(graph),
      slots_(graph.graph().instances().size()),
      lists_(static_cast<std::size_t>(n_workers)),
      records_(slots_.size())
{
  const auto& instances = graph.graph().instances();
  const int n_patches = graph.graph().layout().size();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    slots_[i].predecessors = instances[i].predecessors;
    const int home = std::max(0, instances[i].patch) * n_workers / n_patches;
    lists_[static_cast<std::size_t>(home)].push_back(static_cast<int>(i));
  }
}

}  // namespace tamp::runtime
