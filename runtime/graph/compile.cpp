#include "runtime/graph/compile.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace tamp::runtime
{

namespace
{

bool touches_particles(const TaskDeclaration& declaration)
{
  return std::any_of(declaration.accesses.begin(), declaration.accesses.end(),
                     [](const Access& a) { return a.label->centring() == Centring::particle; });
}

class Compiler
{
 public:
  Compiler(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams, const PatchLayout& layout,
           int n_groups)
      : declarations_(declarations), streams_(streams), layout_(layout), n_groups_(n_groups)
  {
  }

  CompiledStep compile()
  {
    for (int d = 0; d < n_declarations(); ++d) expand(d);
    for (int d = 0; d < n_declarations(); ++d) {
      if (at(d).domain == Domain::migration) {
        connect_migration(d);
      } else {
        connect(d);
      }
    }
    keep_versions_apart();
    measure_messages();
    return std::move(step_);
  }

 private:
  using Place = std::tuple<int, int, int>;  // declaration, patch, group

  int n_declarations() const { return static_cast<int>(declarations_.size()); }
  const TaskDeclaration& at(int declaration) const { return declarations_[static_cast<std::size_t>(declaration)]; }
  Instance& instance(int i) { return step_.instances[static_cast<std::size_t>(i)]; }

  int add(Instance fresh)
  {
    if (fresh.patch >= 0) fresh.rank = layout_[fresh.patch].rank;
    step_.instances.push_back(std::move(fresh));
    return static_cast<int>(step_.instances.size()) - 1;
  }

  /// An instance on a patch, for one group or -1.
  int add(InstanceKind kind, int declaration, int patch, int group)
  {
    Instance fresh;
    fresh.kind = kind;
    fresh.declaration = declaration;
    fresh.patch = patch;
    fresh.group = group;
    return add(std::move(fresh));
  }

  void expand(int d)
  {
    for (const Patch& patch : layout_) {
      for (const int group : groups_of(at(d), n_groups_)) {
        const Place place{d, patch.id, group};
        if (at(d).domain == Domain::migration) {
          senders_[place] = add(InstanceKind::send_particles, d, patch.id, group);
          receivers_[place] = add(InstanceKind::receive_particles, d, patch.id, group);
        } else {
          bodies_[place] = add(InstanceKind::body, d, patch.id, group);
          add_halo_sum(place);
        }
      }
    }
    for (const Access& access : at(d).accesses) {
      if (access.mode == Mode::reduce) add_combiners(d, access.label);
    }
  }

  void add_halo_sum(const Place& place)
  {
    const auto& [d, patch, group] = place;
    std::vector<const Label*> labels;
    int halo = 0;
    for (const Access& access : at(d).accesses) {
      if (access.mode != Mode::accumulate) continue;
      labels.push_back(access.label);
      halo = std::max(halo, access.halo);
    }
    if (labels.empty()) return;
    const int sum = add(InstanceKind::sum_halo, d, patch, group);
    instance(sum).labels = labels;
    instance(sum).halo = halo;
    sums_[place] = sum;
  }

  /// Every rank makes the whole value, of the same parts in the same order.
  void add_combiners(int d, const Label* label)
  {
    if (combiners_.contains({label, 0})) return;
    for (int rank = 0; rank < layout_.n_ranks(); ++rank) {
      Instance combine;
      combine.kind = InstanceKind::combine;
      combine.declaration = d;
      combine.rank = rank;
      combine.labels = {label};
      combiners_[{label, rank}] = add(std::move(combine));
    }
  }

  void edge(int from, int to, const Label* label, int halo, std::size_t bytes, int message = -1)
  {
    if (from != to) step_.edges.push_back({from, to, label, halo, bytes, message});
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

  /// Data that `consumer` needs of another patch. `producer` makes it; -1 for what is there when the step begins.
  struct Transfer {
    int producer;
    int consumer;
    MessagePart part;
    int halo;
    std::size_t bytes;
    /// The declaration that makes this version of the data; -1 for the step before. It tells messages apart.
    int maker;
  };

  void transfer(const Transfer& t)
  {
    const int from = layout_[t.part.from_patch].rank;
    const int to = instance(t.consumer).rank;
    if (from == to) {
      if (t.producer >= 0) edge(t.producer, t.consumer, t.part.label, t.halo, t.bytes);
      return;
    }
    const int m = message(t, from, to);
    Message& message = step_.messages[static_cast<std::size_t>(m)];
    message.parts.push_back(t.part);
    message.consumers.push_back(t.consumer);
    if (t.producer >= 0) edge(t.producer, message.send, t.part.label, t.halo, t.bytes, m);
    edge(message.receive, t.consumer, t.part.label, t.halo, t.bytes, m);
  }

  /// The one message from rank to rank for the purpose of a transfer.
  int message(const Transfer& t, int from, int to)
  {
    const InstanceKind purpose = instance(t.consumer).kind;
    const Label* label =
        purpose == InstanceKind::fill_halo || purpose == InstanceKind::combine ? t.part.label : nullptr;
    const auto [found, fresh] =
        messages_.try_emplace({purpose, label, t.maker, from, to}, static_cast<int>(step_.messages.size()));
    if (fresh) {
      Instance send;
      send.kind = InstanceKind::send_message;
      send.declaration = t.maker >= 0 ? t.maker : instance(t.consumer).declaration;
      send.rank = from;
      send.message = found->second;
      Instance receive = send;
      receive.kind = InstanceKind::receive_message;
      receive.declaration = instance(t.consumer).declaration;
      receive.rank = to;
      Message message{purpose, from, to, add(std::move(send)), add(std::move(receive)), {}, {}, 0};
      edge(message.send, message.receive, t.part.label, t.halo, 0, found->second);
      step_.messages.push_back(std::move(message));
    }
    return found->second;
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
    const auto found = sums_.find({d, patch.id, group});
    if (found == sums_.end()) return;
    const int sum = found->second;
    const int halo = instance(sum).halo;
    const std::vector<const Label*> labels = instance(sum).labels;
    for (const Label* label : labels) {
      const IndexBox box = box_of(*label, patch.id, halo);
      edge(bodies_.at({d, patch.id, group}), sum, label, halo, bytes_of(*label, box));
      for (const int other : patch.neighbours) {
        const IndexBox shared = intersection(box, box_of(*label, other, halo));
        transfer({bodies_.at({d, other, group}),
                  sum,
                  {label, other, patch.id, group, FieldBuffer::part, shared},
                  halo,
                  bytes_of(*label, shared),
                  d});
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
        connect_reducer(self, patch, access.label);
        break;
      case Mode::compute:
      case Mode::accumulate:
        break;
    }
  }

  void connect_reducer(int self, int patch, const Label* label)
  {
    const int group = instance(self).group;
    for (int rank = 0; rank < layout_.n_ranks(); ++rank) {
      transfer({self,
                combiners_.at({label, rank}),
                {label, patch, -1, group, FieldBuffer::current, {}},
                0,
                label->value_bytes(),
                0});
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
      const bool reduced = access.label->centring() == Centring::reduction;
      edge(instance_of(*stream.version_before(d), patch, group), self, access.label, access.halo,
           reduced ? access.label->value_bytes() : bytes_of(*access.label, box_of(*access.label, patch, supplied)));
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
    if (use.access.mode == Mode::reduce) return combiners_.at({use.access.label, layout_[patch].rank});
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
      const int filler = add(InstanceKind::fill_halo, d, patch, group);
      found->second = filler;
      instance(filler).labels = {access.label};
      instance(filler).of_previous_step = access.of_previous_step;
      instance(filler).halo = access.halo;
      connect_filler(d, filler, patch, group, access, version, stream);
    }
    instance(found->second).halo = std::max(instance(found->second).halo, access.halo);
    return found->second;
  }

  void connect_filler(int d, int filler, int patch, int group, const Access& access, const Use* version,
                      const LabelStream& stream)
  {
    const Label* label = access.label;
    const IndexBox box = box_of(*label, patch, access.halo);
    for (const int other : layout_[patch].neighbours) {
      const IndexBox shared = intersection(box, box_of(*label, other, 0));
      const FieldBuffer buffer = version == nullptr ? FieldBuffer::previous : FieldBuffer::current;
      const Transfer t{version == nullptr ? -1 : instance_of(*version, other, group),
                       filler,
                       {label, other, patch, group, buffer, shared},
                       access.halo,
                       bytes_of(*label, shared),
                       version == nullptr ? -1 : version->declaration};
      transfer(t);
      if (version == nullptr) continue;
      // The values may change once they are copied: by the filler, or for a filler elsewhere by the message's sender.
      const int from = layout_[other].rank;
      const int to = layout_[patch].rank;
      const int copier = from == to ? filler : step_.messages[static_cast<std::size_t>(message(t, from, to))].send;
      before_next_update(d, copier, other, group, stream, label);
    }
    if (version != nullptr) edge(instance_of(*version, patch, group), filler, label, 0, 0);
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
          if (access.mode == Mode::read) edge(combiners_.at({access.label, patch.rank}), sender, access.label, 0, 0);
        }
        edge(sender, receiver, position, 0, 0);
        for (const int other : patch.neighbours) {
          transfer({senders_.at({d, other, group}),
                    receiver,
                    {position, other, patch.id, group, FieldBuffer::current, {}},
                    0,
                    0,
                    d});
        }
      }
    }
  }

  /// Several versions of a label come into the same copies of the other rank's patches: one is used before the next.
  void keep_versions_apart()
  {
    for (const auto& [key, earlier] : messages_) {
      const auto& [purpose, label, maker, from, to] = key;
      if (purpose != InstanceKind::fill_halo || maker < 0) continue;
      for (const auto& [other, later] : messages_) {
        const bool next = std::get<0>(other) == purpose && std::get<1>(other) == label && std::get<2>(other) > maker &&
                          std::get<3>(other) == from && std::get<4>(other) == to;
        if (!next) continue;
        const int receive = step_.messages[static_cast<std::size_t>(later)].receive;
        for (const int user : step_.messages[static_cast<std::size_t>(earlier)].consumers)
          edge(user, receive, label, 0, 0);
      }
    }
  }

  /// Halos may have grown with later readers: only now is it known how much of a patch goes along.
  void measure_messages()
  {
    for (Message& message : step_.messages) {
      for (std::size_t k = 0; k < message.parts.size(); ++k) {
        MessagePart& part = message.parts[k];
        if (message.purpose == InstanceKind::combine) message.bytes += part.label->value_bytes();
        if (message.purpose != InstanceKind::fill_halo && message.purpose != InstanceKind::sum_halo) continue;
        const int halo = instance(message.consumers[k]).halo;
        const int given = message.purpose == InstanceKind::sum_halo ? halo : 0;
        part.box = intersection(box_of(*part.label, part.to_patch, halo), box_of(*part.label, part.from_patch, given));
        message.bytes += bytes_of(*part.label, part.box);
      }
    }
  }

  const std::vector<TaskDeclaration>& declarations_;
  const LabelStreams& streams_;
  const PatchLayout& layout_;
  int n_groups_;
  CompiledStep step_;
  std::map<Place, int> bodies_, sums_, senders_, receivers_;
  std::map<std::pair<const Label*, int>, int> combiners_;
  std::map<std::tuple<const Label*, int, int, int>, int> fillers_;
  std::map<std::tuple<InstanceKind, const Label*, int, int, int>, int> messages_;
};

}  // namespace

CompiledStep compile(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams,
                     const PatchLayout& layout, int n_groups)
{
  return Compiler(declarations, streams, layout, n_groups).compile();
}

}  // namespace tamp::runtime
