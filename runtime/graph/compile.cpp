#include "runtime/graph/compile.hpp"

#include <algorithm>
#include <iterator>
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
      : declarations_(declarations), streams_(streams), layout_(layout), n_groups_(n_groups), step_(layout)
  {
  }

  CompiledStep compile()
  {
    for (int d = 0; d < n_declarations(); ++d) expand(d);
    for (int d = 0; d < n_declarations(); ++d) {
      switch (at(d).domain) {
        case Domain::migration:
          connect_migration(d);
          break;
        case Domain::ranks:
          connect_over_ranks(d);
          break;
        default:
          connect(d);
      }
    }
    return step_.finish();
  }

 private:
  using Place = std::tuple<int, int, int>;  // declaration, patch, group

  int n_declarations() const { return static_cast<int>(declarations_.size()); }
  const TaskDeclaration& at(int declaration) const { return declarations_[static_cast<std::size_t>(declaration)]; }
  Instance& instance(int i) { return step_.instance(i); }

  void expand(int d)
  {
    if (at(d).domain == Domain::ranks) {
      for (int rank = 0; rank < layout_.n_ranks(); ++rank) {
        rank_bodies_[{d, rank}] = step_.add_on_rank(InstanceKind::body, d, rank);
      }
      return;
    }
    for (const Patch& patch : layout_) {
      for (const int group : groups_of(at(d), n_groups_)) {
        const Place place{d, patch.id, group};
        if (at(d).domain == Domain::migration) {
          senders_[place] = step_.add_on_patch(InstanceKind::send_particles, d, patch.id, group);
          receivers_[place] = step_.add_on_patch(InstanceKind::receive_particles, d, patch.id, group);
        } else {
          bodies_[place] = step_.add_on_patch(InstanceKind::body, d, patch.id, group);
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
      const LabelStream& stream = stream_at(streams_, access.label, group, d);
      if (!stream.is_summed_after(d)) continue;
      labels.push_back(access.label);
      halo = std::max(halo, stream.producers.back().access.halo);
    }
    if (labels.empty()) return;
    const int sum = step_.add_on_patch(InstanceKind::sum_halo, d, patch, group);
    instance(sum).labels = labels;
    instance(sum).halo = halo;
    sums_[place] = sum;
  }

  /// Every rank makes the whole value, of the same parts in the same order.
  void add_combiners(int d, const Label* label)
  {
    if (combiners_.contains({label, 0})) return;
    for (int rank = 0; rank < layout_.n_ranks(); ++rank) {
      const int combine = step_.add_on_rank(InstanceKind::combine, d, rank);
      instance(combine).labels = {label};
      combiners_[{label, rank}] = combine;
    }
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

  /// A task over ranks: what it uses is there on every rank.
  void connect_over_ranks(int d)
  {
    for (const Access& access : at(d).accesses) {
      if (access.mode != Mode::read || access.of_previous_step) continue;
      const Use& maker = *stream_at(streams_, access.label, -1, d).version_before(d);
      for (int rank = 0; rank < layout_.n_ranks(); ++rank) {
        step_.edge(one_value_on(maker, rank), rank_bodies_.at({d, rank}), access.label, 0, access.label->value_bytes());
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
      const IndexBox box = step_.box_of(*label, patch.id, halo);
      step_.edge(bodies_.at({d, patch.id, group}), sum, label, halo, step_.bytes_of(*label, box));
      for (const PatchImage& image : patch.images) {
        const int other = image.patch;
        if (other == patch.id) continue;
        const IndexBox shared = step_.shared_box(*label, box, image, halo);
        const Transfer part{bodies_.at({d, other, group}),
                            sum,
                            {label, other, patch.id, group, FieldBuffer::part, shared, image.shift},
                            halo,
                            step_.bytes_of(*label, shared),
                            d};
        step_.transfer(part);
        connect_after_sum_before(d, part);
      }
      connect_after_readers_before(d, sum, patch.id, group, label);
    }
  }

  /// A part that begins anew waits until its earlier sum is complete, here and on the neighbour.
  void connect_after_sum_before(int d, const Transfer& part)
  {
    const Label* label = part.part.label;
    const int group = part.part.group;
    const LabelStream* before = stream_before(streams_, label, group, d);
    if (before == nullptr) return;
    const int last = before->producers.back().declaration;
    const int first = stream_at(streams_, label, group, d).producers.front().declaration;
    const int former_sum = sums_.at({last, part.part.to_patch, group});
    const Transfer former{-1, former_sum, part.part, part.halo, part.bytes, last};
    step_.edge(step_.copier(former), bodies_.at({first, part.part.from_patch, group}), label, 0, 0);
    step_.edge(former_sum, step_.receiver(part), label, 0, 0);
  }

  /// A sum that begins anew overwrites the earlier one, so it waits for the tasks that read or change that one.
  void connect_after_readers_before(int d, int sum, int patch, int group, const Label* label)
  {
    const LabelStream* before = stream_before(streams_, label, group, d);
    if (before == nullptr) return;
    const int first = stream_at(streams_, label, group, d).producers.front().declaration;
    step_.edge(sums_.at({before->producers.back().declaration, patch, group}), bodies_.at({first, patch, group}), label,
               0, 0);
    for (const std::vector<Use>* uses : {&before->readers, &before->updaters}) {
      for (const Use& use : *uses) {
        if (!use.access.of_previous_step) step_.edge(body_of(use, patch, group), sum, label, 0, 0);
      }
    }
  }

  void connect_access(int d, int self, int patch, int group, const Access& access)
  {
    const LabelStream& stream = stream_at(streams_, access.label, group, d);
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
      case Mode::accumulate:
        connect_adder(d, self, patch, group, access, stream);
        break;
      case Mode::compute:
        break;
    }
  }

  /// Tasks that accumulate one label add their parts in the order of declaration.
  void connect_adder(int d, int self, int patch, int group, const Access& access, const LabelStream& stream)
  {
    const auto own = std::find_if(stream.producers.begin(), stream.producers.end(),
                                  [&](const Use& use) { return use.declaration == d; });
    if (own == stream.producers.begin()) {
      instance(self).begun.push_back(access.label);
      return;
    }
    step_.edge(bodies_.at({std::prev(own)->declaration, patch, group}), self, access.label, access.halo,
               step_.bytes_of(*access.label, step_.box_of(*access.label, patch, access.halo)));
  }

  void connect_reducer(int self, int patch, const Label* label)
  {
    const int group = instance(self).group;
    for (int rank = 0; rank < layout_.n_ranks(); ++rank) {
      step_.transfer({self,
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
      step_.edge(halo_filler(d, patch, group, access, stream), self, access.label, access.halo,
                 step_.bytes_of(*access.label, step_.box_of(*access.label, patch, access.halo)));
    }
    if (!access.of_previous_step) {
      const bool is_one = has_one_value(access.label->centring());
      step_.edge(instance_of(*stream.version_before(d), patch, group), self, access.label, access.halo,
                 is_one ? access.label->value_bytes()
                        : step_.bytes_of(*access.label, step_.box_of(*access.label, patch, supplied)));
      before_next_update(d, self, patch, group, stream, access.label);
    }
  }

  /// A changer waits for the version it changes; whoever reads that version goes first (see `before_next_update`).
  void connect_updater(int d, int self, int patch, int group, const Access& access, const LabelStream& stream)
  {
    step_.edge(instance_of(*stream.version_before(d), patch, group), self, access.label, access.halo,
               step_.bytes_of(*access.label, step_.box_of(*access.label, patch, access.halo)));
  }

  void before_next_update(int d, int reader, int patch, int group, const LabelStream& stream, const Label* label)
  {
    for (const Use& updater : stream.updaters) {
      if (updater.declaration <= d || at(updater.declaration).domain == Domain::migration) continue;
      step_.edge(reader, instance_of(updater, patch, group), label, 0, 0);
      return;
    }
  }

  /// The instance after which the version that `use` made is there on a patch.
  int instance_of(const Use& use, int patch, int group) const
  {
    if (has_one_value(use.access.label->centring())) return one_value_on(use, layout_[patch].rank);
    return use.access.mode == Mode::accumulate ? sums_.at({use.declaration, patch, group}) : body_of(use, patch, group);
  }

  int body_of(const Use& use, int patch, int group) const
  {
    return bodies_.at({use.declaration, patch, at(use.declaration).domain == Domain::patches ? -1 : group});
  }

  /// The instance after which a rank has the reduction or the global that `use` makes.
  int one_value_on(const Use& use, int rank) const
  {
    return use.access.mode == Mode::reduce ? combiners_.at({use.access.label, rank})
                                           : rank_bodies_.at({use.declaration, rank});
  }

  /// The copy of neighbours' values into the halo of a patch, shared by all who read the same version.
  int halo_filler(int d, int patch, int group, const Access& access, const LabelStream& stream)
  {
    const Use* version = access.of_previous_step ? nullptr : stream.version_before(d);
    const int maker = version == nullptr ? -1 : version->declaration;
    const auto [found, fresh] = fillers_.try_emplace({access.label, group, patch, maker}, -1);
    if (fresh) {
      const int filler = step_.add_on_patch(InstanceKind::fill_halo, d, patch, group);
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
    const IndexBox box = step_.box_of(*label, patch, access.halo);
    for (const PatchImage& image : layout_[patch].images) {
      const int other = image.patch;
      if (other == patch) continue;
      const IndexBox shared = step_.shared_box(*label, box, image, 0);
      const FieldBuffer buffer = version == nullptr ? FieldBuffer::previous : FieldBuffer::current;
      const Transfer t{version == nullptr ? -1 : instance_of(*version, other, group),
                       filler,
                       {label, other, patch, group, buffer, shared, image.shift},
                       access.halo,
                       step_.bytes_of(*label, shared),
                       version == nullptr ? -1 : version->declaration};
      step_.transfer(t);
      // The values may change once they are copied.
      if (version != nullptr) before_next_update(d, step_.copier(t), other, group, stream, label);
    }
    if (version != nullptr) step_.edge(instance_of(*version, patch, group), filler, label, 0, 0);
  }

  /// The bodies of all tasks that touch the particles of a group on a patch.
  std::vector<int> bodies_with_particles(int patch, int group) const
  {
    std::vector<int> bodies;
    for (int d = 0; d < n_declarations(); ++d) {
      if (!touches_particles(at(d))) continue;
      for (const int g : {-1, group}) {
        const auto body = bodies_.find({d, patch, g});
        if (body != bodies_.end()) bodies.push_back(body->second);
      }
    }
    return bodies;
  }

  /// Particles move when all else that touches particles of the patch is done.
  void connect_migration(int d)
  {
    const Label* position = at(d).accesses.front().label;
    for (const Patch& patch : layout_) {
      for (const int group : groups_of(at(d), n_groups_)) {
        const int sender = senders_.at({d, patch.id, group});
        const int receiver = receivers_.at({d, patch.id, group});
        for (const int body : bodies_with_particles(patch.id, group)) step_.edge(body, sender, position, 0, 0);
        for (const Access& access : at(d).accesses) {
          if (access.mode != Mode::read) continue;
          const Use& maker = *stream_at(streams_, access.label, -1, d).version_before(d);
          step_.edge(one_value_on(maker, patch.rank), sender, access.label, 0, 0);
        }
        step_.edge(sender, receiver, position, 0, 0);
        for (const int other : patch.neighbours) {
          step_.transfer({senders_.at({d, other, group}),
                          receiver,
                          {position, other, patch.id, group, FieldBuffer::current, {}},
                          0,
                          0,
                          d});
        }
      }
    }
  }

  const std::vector<TaskDeclaration>& declarations_;
  const LabelStreams& streams_;
  const PatchLayout& layout_;
  int n_groups_;
  StepBuilder step_;
  std::map<Place, int> bodies_, sums_, senders_, receivers_;
  std::map<std::pair<int, int>, int> rank_bodies_;  // declaration, rank
  std::map<std::pair<const Label*, int>, int> combiners_;
  std::map<std::tuple<const Label*, int, int, int>, int> fillers_;
};

}  // namespace

CompiledStep compile(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams,
                     const PatchLayout& layout, int n_groups)
{
  return Compiler(declarations, streams, layout, n_groups).compile();
}

}  // namespace tamp::runtime
