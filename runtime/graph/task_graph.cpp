#include "runtime/graph/task_graph.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "runtime/graph/label_streams.hpp"

namespace tamp::runtime
{

namespace
{

bool touches_particles(const TaskDeclaration& declaration)
{
  return std::any_of(declaration.accesses.begin(), declaration.accesses.end(),
                     [](const Access& a) { return a.label->centring() == Centring::particle; });
}

/// Expands declarations into instances and infers the edges between them.
class Compiler
{
 public:
  Compiler(const std::vector<TaskDeclaration>& declarations, const PatchLayout& layout, int n_groups,
           const LabelStreams& streams)
      : declarations_(declarations), layout_(layout), n_groups_(n_groups), streams_(streams)
  {
  }

  void compile()
  {
    for (int d = 0; d < n_declarations(); ++d) expand(d);
    for (int d = 0; d < n_declarations(); ++d) {
      if (at(d).domain == Domain::migration) {
        connect_migration(d);
      } else {
        connect(d);
      }
    }
  }

  std::vector<Instance> instances;
  std::vector<Edge> edges;

 private:
  using Place = std::tuple<int, int, int>;  // declaration, patch, group

  int n_declarations() const { return static_cast<int>(declarations_.size()); }
  const TaskDeclaration& at(int declaration) const { return declarations_[static_cast<std::size_t>(declaration)]; }

  int add(Instance instance)
  {
    instances.push_back(std::move(instance));
    return static_cast<int>(instances.size()) - 1;
  }

  void expand(int d)
  {
    for (const Patch& patch : layout_) {
      for (const int group : groups_of(at(d), n_groups_)) {
        if (at(d).domain == Domain::migration) {
          senders_[{d, patch.id, group}] = add({InstanceKind::send_particles, d, patch.id, group, {}, false, 0, {}});
          receivers_[{d, patch.id, group}] =
              add({InstanceKind::receive_particles, d, patch.id, group, {}, false, 0, {}});
        } else {
          bodies_[{d, patch.id, group}] = add({InstanceKind::body, d, patch.id, group, {}, false, 0, {}});
          add_halo_sum(d, patch.id, group);
        }
      }
    }
    for (const Access& access : at(d).accesses) {
      if (access.mode != Mode::reduce || combiners_.contains(access.label)) continue;
      combiners_[access.label] = add({InstanceKind::combine, d, -1, -1, {access.label}, false, 0, {}});
    }
  }

  void add_halo_sum(int d, int patch, int group)
  {
    Instance sum{InstanceKind::sum_halo, d, patch, group, {}, false, 0, {}};
    for (const Access& access : at(d).accesses) {
      if (access.mode != Mode::accumulate) continue;
      sum.labels.push_back(access.label);
      sum.halo = std::max(sum.halo, access.halo);
    }
    if (!sum.labels.empty()) sums_[{d, patch, group}] = add(std::move(sum));
  }

  void edge(int from, int to, const Label* label, int halo, std::size_t bytes)
  {
    if (from != to) edges.push_back({from, to, label, halo, bytes});
  }

  std::size_t bytes_of(const Label& label, const IndexBox& box) const
  {
    return static_cast<std::size_t>(box.size()) * label.value_bytes();
  }

  IndexBox box_of(const Label& label, int patch, int halo) const
  {
    return grown(label.centring() == Centring::node ? layout_[patch].nodes : layout_[patch].cells, halo,
                 layout_.grid().dimension);
  }

  /// A task body: the instances that make and change what it uses come before it.
  void connect(int d)
  {
    for (const Patch& patch : layout_) {
      for (const int group : groups_of(at(d), n_groups_)) {
        const int self = bodies_.at({d, patch.id, group});
        for (const Access& access : at(d).accesses) {
          for (const int data_group : groups_of(access, group, n_groups_)) {
            connect_access(d, self, patch.id, data_group, access);
          }
        }
        connect_halo_sum(d, patch, group);
      }
    }
  }

  void connect_halo_sum(int d, const Patch& patch, int group)
  {
    const auto sum = sums_.find({d, patch.id, group});
    if (sum == sums_.end()) return;
    const Instance& self = instances[static_cast<std::size_t>(sum->second)];
    for (const Label* label : self.labels) {
      const IndexBox box = box_of(*label, patch.id, self.halo);
      edge(bodies_.at({d, patch.id, group}), sum->second, label, self.halo, bytes_of(*label, box));
      for (const int other : patch.neighbours) {
        const IndexBox shared = intersection(box, box_of(*label, other, self.halo));
        edge(bodies_.at({d, other, group}), sum->second, label, self.halo, bytes_of(*label, shared));
      }
    }
  }

  void connect_access(int d, int self, int patch, int group, const Access& access)
  {
    const LabelStream& stream = streams_.at({access.label, group});
    switch (access.mode) {
      case Mode::read:
        connect_reader(d, self, patch, group, access, stream);
        break;
      case Mode::update:
        connect_updater(d, self, patch, group, access, stream);
        break;
      case Mode::reduce:
        edge(self, combiners_.at(access.label), access.label, 0, access.label->value_bytes());
        break;
      case Mode::compute:
      case Mode::accumulate:
        break;
    }
  }

  void connect_reader(int d, int self, int patch, int group, const Access& access, const LabelStream& stream)
  {
    const int supplied = access.of_previous_step ? 0 : stream.version_before(d)->access.halo;
    if (access.halo > supplied) {
      edge(halo_filler(d, patch, group, access, stream), self, access.label, access.halo,
           bytes_of(*access.label, box_of(*access.label, patch, access.halo)));
    }
    if (!access.of_previous_step) {
      edge(instance_of(*stream.version_before(d), patch, group), self, access.label, access.halo,
           bytes_of(*access.label, box_of(*access.label, patch, supplied)));
      before_next_update(d, self, patch, group, stream, access.label);
    }
  }

  /// A changer waits for the version it changes; whoever reads that version goes first (see `before_next_update`).
  void connect_updater(int d, int self, int patch, int group, const Access& access, const LabelStream& stream)
  {
    edge(instance_of(*stream.version_before(d), patch, group), self, access.label, access.halo,
         bytes_of(*access.label, box_of(*access.label, patch, access.halo)));
  }

  void before_next_update(int d, int reader, int patch, int group, const LabelStream& stream, const Label* label)
  {
    for (const Use& updater : stream.updaters) {
      if (updater.declaration <= d || at(updater.declaration).domain == Domain::migration) continue;
      edge(reader, instance_of(updater, patch, group), label, 0, 0);
      return;
    }
  }

  /// The instance after which the version that `use` made is there on a patch.
  int instance_of(const Use& use, int patch, int group) const
  {
    if (use.access.mode == Mode::reduce) return combiners_.at(use.access.label);
    const int task_group = at(use.declaration).domain == Domain::patches ? -1 : group;
    const Place place{use.declaration, patch, task_group};
    return use.access.mode == Mode::accumulate ? sums_.at(place) : bodies_.at(place);
  }

  /// The copy of neighbours' values into the halo of a patch, shared by all who read the same version.
  int halo_filler(int d, int patch, int group, const Access& access, const LabelStream& stream)
  {
    const Use* version = access.of_previous_step ? nullptr : stream.version_before(d);
    const int maker = version == nullptr ? -1 : version->declaration;
    const auto [found, fresh] = fillers_.try_emplace({access.label, group, patch, maker}, -1);
    if (fresh) {
      found->second =
          add({InstanceKind::fill_halo, d, patch, group, {access.label}, access.of_previous_step, access.halo, {}});
      if (version != nullptr) {
        connect_filler(d, found->second, patch, group, access, *version, stream);
      }
    }
    Instance& filler = instances[static_cast<std::size_t>(found->second)];
    filler.halo = std::max(filler.halo, access.halo);
    return found->second;
  }

  void connect_filler(int d, int filler, int patch, int group, const Access& access, const Use& version,
                      const LabelStream& stream)
  {
    const IndexBox box = box_of(*access.label, patch, access.halo);
    for (const int other : layout_[patch].neighbours) {
      const IndexBox shared = intersection(box, box_of(*access.label, other, 0));
      edge(instance_of(version, other, group), filler, access.label, access.halo, bytes_of(*access.label, shared));
      before_next_update(d, filler, other, group, stream, access.label);
    }
    edge(instance_of(version, patch, group), filler, access.label, 0, 0);
  }

  /// Particles move when all else that touches particles of the patch is done.
  void connect_migration(int d)
  {
    const Label* position = at(d).accesses.front().label;
    for (const Patch& patch : layout_) {
      for (const int group : groups_of(at(d), n_groups_)) {
        const int sender = senders_.at({d, patch.id, group});
        const int receiver = receivers_.at({d, patch.id, group});
        for (const auto& [place, body] : bodies_) {
          const auto& [declaration, body_patch, body_group] = place;
          const bool same = body_patch == patch.id && (body_group == group || body_group == -1);
          if (same && touches_particles(at(declaration))) edge(body, sender, position, 0, 0);
        }
        for (const Access& access : at(d).accesses) {
          if (access.mode == Mode::read) edge(combiners_.at(access.label), sender, access.label, 0, 0);
        }
        edge(sender, receiver, position, 0, 0);
        for (const int other : patch.neighbours) edge(senders_.at({d, other, group}), receiver, position, 0, 0);
      }
    }
  }

  const std::vector<TaskDeclaration>& declarations_;
  const PatchLayout& layout_;
  int n_groups_;
  const LabelStreams& streams_;
  std::map<Place, int> bodies_, sums_, senders_, receivers_;
  std::map<const Label*, int> combiners_;
  std::map<std::tuple<const Label*, int, int, int>, int> fillers_;
};

/// Kahn's algorithm, lowest declaration and patch first. Returns fewer instances than there are when a cycle is left.
std::vector<int> serial_order(const std::vector<Instance>& instances, const std::vector<Edge>& edges)
{
  std::vector<int> n_waiting(instances.size(), 0);
  std::vector<std::vector<int>> followers(instances.size());
  for (const Edge& e : edges) {
    ++n_waiting[static_cast<std::size_t>(e.to)];
    followers[static_cast<std::size_t>(e.from)].push_back(e.to);
  }
  std::set<std::tuple<int, int, int>> ready;  // declaration, patch, instance
  const auto offer = [&](int i) {
    const Instance& instance = instances[static_cast<std::size_t>(i)];
    ready.insert({instance.declaration, instance.patch, i});
  };
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (n_waiting[i] == 0) offer(static_cast<int>(i));
  }
  std::vector<int> order;
  while (!ready.empty()) {
    const int next = std::get<2>(*ready.begin());
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

/// Renumbers instances and edges into `order` and lists each instance's predecessors.
void put_in_order(const std::vector<int>& order, std::vector<Instance>& instances, std::vector<Edge>& edges)
{
  std::vector<int> place(instances.size());
  std::vector<Instance> sorted;
  for (const int i : order) {
    place[static_cast<std::size_t>(i)] = static_cast<int>(sorted.size());
    sorted.push_back(std::move(instances[static_cast<std::size_t>(i)]));
  }
  for (Edge& e : edges) {
    e.from = place[static_cast<std::size_t>(e.from)];
    e.to = place[static_cast<std::size_t>(e.to)];
    sorted[static_cast<std::size_t>(e.to)].predecessors.push_back(e.from);
  }
  for (Instance& instance : sorted) {
    auto& list = instance.predecessors;
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to, a.label->name(), a.bytes) < std::tie(b.from, b.to, b.label->name(), b.bytes);
  });
  instances = std::move(sorted);
}

std::vector<LabelUse> list_uses(const LabelStreams& streams, const HostData& host, int n_groups)
{
  std::vector<LabelUse> uses;
  const auto is_state = [&](const Label* label) {
    return std::find(host.state.begin(), host.state.end(), label) != host.state.end();
  };
  for (const auto& [key, stream] : streams) {
    LabelUse use{key.first, key.second, is_state(key.first), !stream.producers.empty(), false};
    use.accumulated = use.computed && stream.producers.front().access.mode == Mode::accumulate;
    uses.push_back(use);
  }
  // State that no task of this graph names must still be kept, and must move with its particles.
  for (const Label* label : host.state) {
    const bool named =
        std::any_of(streams.begin(), streams.end(), [&](const auto& s) { return s.first.first == label; });
    for (int g = 0; g < n_groups && !named; ++g) uses.push_back({label, g, true, false, false});
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
  Compiler compiler(declarations_, layout, n_groups(), streams);
  compiler.compile();
  const std::vector<int> order = serial_order(compiler.instances, compiler.edges);
  if (order.size() != compiler.instances.size()) {
    throw GraphError({describe_cycle(*this, compiler.instances, compiler.edges, order)});
  }
  put_in_order(order, compiler.instances, compiler.edges);
  instances_ = std::move(compiler.instances);
  edges_ = std::move(compiler.edges);
  label_uses_ = list_uses(streams, host, n_groups());
  for (const TaskDeclaration& declaration : declarations_) {
    for (const Access& access : declaration.accesses) storage_halo_ = std::max(storage_halo_, access.halo);
  }
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
  }
  return declared;
}

}  // namespace tamp::runtime
