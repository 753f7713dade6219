#include "runtime/graph/task_graph.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "runtime/graph/compile.hpp"
#include "runtime/graph/label_streams.hpp"

namespace tamp::runtime
{

namespace
{

/// The patches whose data other ranks need.
std::vector<bool> patches_at_borders(const PatchLayout& layout)
{
  std::vector<bool> at_border;
  for (const Patch& patch : layout) {
    at_border.push_back(std::any_of(patch.neighbours.begin(), patch.neighbours.end(),
                                    [&](int other) { return layout[other].rank != patch.rank; }));
  }
  return at_border;
}

/// Kahn's algorithm, lowest declaration first. Within one, what a message waits for goes before what none does, and
/// what waits for a message comes last: so there is work while messages are on their way. Then the lowest patch.
/// Returns fewer instances than there are when a cycle is left.
std::vector<int> serial_order(const CompiledStep& step, const PatchLayout& layout)
{
  const auto& instances = step.instances;
  std::vector<int> n_waiting(instances.size(), 0);
  std::vector<std::vector<int>> followers(instances.size());
  for (const Edge& e : step.edges) {
    ++n_waiting[static_cast<std::size_t>(e.to)];
    followers[static_cast<std::size_t>(e.from)].push_back(e.to);
  }
  const std::vector<bool> at_border = patches_at_borders(layout);
  const auto haste = [&](const Instance& instance) {
    if (instance.kind == InstanceKind::receive_message) return 2;
    if (instance.kind == InstanceKind::send_message) return 0;
    return instance.patch >= 0 && at_border[static_cast<std::size_t>(instance.patch)] ? 0 : 1;
  };
  std::set<std::tuple<int, int, int, int>> ready;  // declaration, haste, patch, instance
  const auto offer = [&](int i) {
    const Instance& instance = instances[static_cast<std::size_t>(i)];
    ready.insert({instance.declaration, haste(instance), instance.patch, i});
  };
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (n_waiting[i] == 0) offer(static_cast<int>(i));
  }
  std::vector<int> order;
  while (!ready.empty()) {
    const int next = std::get<3>(*ready.begin());
    ready.erase(ready.begin());
    order.push_back(next);
    for (const int follower : followers[static_cast<std::size_t>(next)]) {
      if (--n_waiting[static_cast<std::size_t>(follower)] == 0) offer(follower);
    }
  }
  return order;
}

/// Follows unfinished predecessors until one comes again: the tasks of a cycle, each waiting for the next.
GraphProblem describe_cycle(const TaskGraph& graph, const std::vector<Instance>& instances,
                            const std::vector<Edge>& edges, const std::vector<int>& finished)
{
  std::set<int> left;
  for (int i = 0; i < static_cast<int>(instances.size()); ++i) left.insert(i);
  for (const int i : finished) left.erase(i);

  std::vector<const Edge*> walked;
  std::vector<int> path{*left.begin()};
  while (true) {
    const Edge* back = nullptr;
    for (const Edge& e : edges) {
      if (e.to == path.back() && left.contains(e.from)) back = &e;
    }
    walked.push_back(back);
    const auto first = static_cast<std::size_t>(std::find(path.begin(), path.end(), back->from) - path.begin());
    path.push_back(back->from);
    if (first + 1 < path.size()) {
      std::string chain = "'" + graph.name(instances[static_cast<std::size_t>(path[first])]) + "'";
      for (std::size_t k = first + 1; k < path.size(); ++k) {
        chain += " waits for '" + graph.name(instances[static_cast<std::size_t>(path[k])]) + "' (" +
                 walked[k - 1]->label->name() + ")" + (k + 1 < path.size() ? ", which" : "");
      }
      return {GraphProblem::Kind::cycle, graph.name(instances[static_cast<std::size_t>(path[first])]),
              walked[first]->label->name(), chain};
    }
  }
}

/// Renumbers everything into `order` and lists each instance's predecessors.
void put_in_order(const std::vector<int>& order, CompiledStep& step)
{
  std::vector<int> place(step.instances.size());
  std::vector<Instance> sorted;
  for (const int i : order) {
    place[static_cast<std::size_t>(i)] = static_cast<int>(sorted.size());
    sorted.push_back(std::move(step.instances[static_cast<std::size_t>(i)]));
  }
  const auto renumber = [&](int& i) { i = place[static_cast<std::size_t>(i)]; };
  for (Edge& e : step.edges) {
    renumber(e.from);
    renumber(e.to);
    sorted[static_cast<std::size_t>(e.to)].predecessors.push_back(e.from);
  }
  for (Instance& instance : sorted) {
    auto& list = instance.predecessors;
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  std::sort(step.edges.begin(), step.edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to, a.label->name(), a.bytes) < std::tie(b.from, b.to, b.label->name(), b.bytes);
  });
  for (Message& message : step.messages) {
    renumber(message.send);
    renumber(message.receive);
    for (int& consumer : message.consumers) renumber(consumer);
  }
  step.instances = std::move(sorted);
}

std::vector<LabelUse> list_uses(const LabelStreams& streams, const HostData& host, int n_groups)
{
  std::vector<LabelUse> uses;
  const auto is_state = [&](const Label* label) {
    return std::find(host.state.begin(), host.state.end(), label) != host.state.end();
  };
  for (const auto& [key, of_label] : streams) {
    const std::vector<Use>& producers = of_label.front().producers;
    LabelUse use{key.first, key.second, is_state(key.first), !producers.empty(), false};
    use.accumulated = use.computed && producers.front().access.mode == Mode::accumulate;
    uses.push_back(use);
  }
  // State that no task of this graph names must still be kept, and must move with its particles.
  for (const Label* label : host.state) {
    const bool named =
        std::any_of(streams.begin(), streams.end(), [&](const auto& s) { return s.first.first == label; });
    if (named) continue;
    if (has_one_value(label->centring())) {
      uses.push_back({label, -1, true, false, false});
    } else {
      for (int g = 0; g < n_groups; ++g) uses.push_back({label, g, true, false, false});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const LabelUse& a, const LabelUse& b) {
    return std::tie(a.label->name(), a.group) < std::tie(b.label->name(), b.group);
  });
  return uses;
}

}  // namespace

TaskGraph::TaskGraph(std::vector<TaskDeclaration> declarations, const PatchLayout& layout,
                     std::vector<std::string> group_names, const HostData& host)
    : layout_(&layout), group_names_(std::move(group_names)), declarations_(std::move(declarations))
{
  const LabelStreams streams = collect_streams(declarations_, n_groups());
  if (auto problems = find_problems(declarations_, streams, layout, host, n_groups()); !problems.empty()) {
    throw GraphError(std::move(problems));
  }
  CompiledStep step = compile(declarations_, streams, layout, n_groups());
  const std::vector<int> order = serial_order(step, layout);
  if (order.size() != step.instances.size()) {
    throw GraphError({describe_cycle(*this, step.instances, step.edges, order)});
  }
  put_in_order(order, step);
  instances_ = std::move(step.instances);
  instances_.shrink_to_fit();
  edges_ = std::move(step.edges);
  messages_ = std::move(step.messages);
  label_uses_ = list_uses(streams, host, n_groups());
  for (const Instance& instance : instances_) {
    if (instance.kind != InstanceKind::fill_halo || instance.of_previous_step) continue;
    for (LabelUse& use : label_uses_) use.filled |= use.label == instance.labels.front();
  }
  for (const TaskDeclaration& declaration : declarations_) {
    for (const Access& access : declaration.accesses) storage_halo_ = std::max(storage_halo_, access.halo);
  }
}

/// The name of the work that waits for a message.
std::string TaskGraph::name_of_use(const Instance& instance) const
{
  const Message& message = messages_[static_cast<std::size_t>(instance.message)];
  return name(instances_[static_cast<std::size_t>(message.consumers.front())]);
}

std::string TaskGraph::name(const Instance& instance) const
{
  const std::string& declared = declaration(instance).name;
  switch (instance.kind) {
    case InstanceKind::body:
      return declared;
    case InstanceKind::sum_halo:
      return "sum halo: " + declared;
    case InstanceKind::fill_halo:
      return "fill halo: " + instance.labels.front()->name();
    case InstanceKind::combine:
      return "combine: " + instance.labels.front()->name();
    case InstanceKind::send_particles:
      return declared + ": send";
    case InstanceKind::receive_particles:
      return declared + ": receive";
    case InstanceKind::send_message:
      return "send: " + name_of_use(instance);
    case InstanceKind::receive_message:
      return "receive: " + name_of_use(instance);
  }
  return declared;
}

std::vector<LabelUse> label_uses(std::span<const TaskGraph* const> graphs)
{
  std::vector<LabelUse> merged;
  for (const TaskGraph* graph : graphs) {
    for (const LabelUse& use : graph->label_uses()) {
      const auto same = std::find_if(merged.begin(), merged.end(),
                                     [&](const LabelUse& m) { return m.label == use.label && m.group == use.group; });
      if (same == merged.end()) {
        merged.push_back(use);
      } else {
        same->state |= use.state;
        same->computed |= use.computed;
        same->accumulated |= use.accumulated;
        same->filled |= use.filled;
      }
    }
  }
  return merged;
}

int storage_halo(std::span<const TaskGraph* const> graphs)
{
  int halo = 0;
  for (const TaskGraph* graph : graphs) halo = std::max(halo, graph->storage_halo());
  return halo;
}

}  // namespace tamp::runtime
