#include "runtime/warehouse/storage_forecast.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace tamp::runtime
{

namespace
{

/// Which buffers that are stored on demand are written to, by label, patch and group.
class WrittenBuffers
{
 public:
  WrittenBuffers(std::span<const LabelUse> uses, int n_patches, int n_groups) : n_groups_(n_groups)
  {
    const auto n_places = static_cast<std::size_t>(n_patches * (n_groups + 1));
    for (const LabelUse& use : uses) {
      const Centring centring = use.label->centring();
      const bool on_demand = centring == Centring::reduction || (is_on_grid(centring) && !use.state);
      if (on_demand) of_label_[use.label].resize(n_places);
    }
  }

  bool has(const Label& label, int patch, int group, FieldBuffer buffer) const
  {
    const auto found = of_label_.find(&label);
    return found == of_label_.end() || found->second[place(patch, group)].test(static_cast<std::size_t>(buffer));
  }
  void add(const Label& label, int patch, int group, FieldBuffer buffer)
  {
    const auto found = of_label_.find(&label);
    if (found != of_label_.end()) found->second[place(patch, group)].set(static_cast<std::size_t>(buffer));
  }
  /// Number of buffers written to on a patch for a group, and (below) in all; current values and parts both count.
  std::size_t n_buffers(const Label& label, int patch, int group) const
  {
    return of_label_.at(&label)[place(patch, group)].count();
  }
  std::size_t n_buffers(const Label& label) const
  {
    const auto& places = of_label_.at(&label);
    return std::accumulate(places.begin(), places.end(), std::size_t{0},
                           [](std::size_t n, const std::bitset<3>& buffers) { return n + buffers.count(); });
  }

 private:
  std::size_t place(int patch, int group) const
  {
    return static_cast<std::size_t>(patch * (n_groups_ + 1) + group + 1);
  }

  int n_groups_;
  std::unordered_map<const Label*, std::vector<std::bitset<3>>> of_label_;
};

/// A step of a graph that writes nothing.
class DryStep
{
 public:
  DryStep(const TaskGraph& graph, std::span<const std::size_t> n_particles, WrittenBuffers& written)
      : graph_(graph), n_particles_(n_particles), written_(written)
  {
  }

  void go()
  {
    for (const Instance& instance : graph_.instances()) {
      switch (instance.kind) {
        case InstanceKind::body:
          if (instance.patch >= 0 && !is_skipped(instance)) write(instance);
          break;
        case InstanceKind::sum_halo:
          pass(instance, FieldBuffer::part);
          break;
        case InstanceKind::fill_halo:
          if (!instance.of_previous_step) pass(instance, FieldBuffer::current);
          break;
        default:
          break;
      }
    }
  }

 private:
  /// Calls `visit(access, group)` for the fields of a body.
  template <class Visit>
  void for_each_field(const Instance& instance, const Visit& visit) const
  {
    for (const Access& access : graph_.declaration(instance).accesses) {
      if (access.every_group) {
        for (int g = 0; g < graph_.n_groups(); ++g) visit(access, g);
      } else {
        visit(access, instance.group);
      }
    }
  }

  static FieldBuffer buffer_of(const Access& access)
  {
    return access.mode == Mode::accumulate ? FieldBuffer::part : FieldBuffer::current;
  }

  bool has_particles(int patch, int group) const
  {
    return n_particles_[static_cast<std::size_t>(patch * graph_.n_groups() + group)] > 0;
  }

  bool is_filled_from_neighbours(const Instance& instance) const
  {
    return std::any_of(instance.predecessors.begin(), instance.predecessors.end(), [&](int p) {
      return graph_.instances()[static_cast<std::size_t>(p)].kind == InstanceKind::fill_halo;
    });
  }

  /// Whether an instance is skipped, as BoundGraph finds from the fields themselves, see Sparsity.
  bool is_skipped(const Instance& instance) const
  {
    const Sparsity sparsity = graph_.declaration(instance).sparsity;
    if (sparsity == Sparsity::none || is_filled_from_neighbours(instance)) return false;
    bool particles = false;
    bool fields = false;
    std::bitset<PerGroup<int>::max_groups> groups;
    for_each_field(instance, [&](const Access& access, int group) {
      const Centring centring = access.label->centring();
      if (centring == Centring::particle) particles |= has_particles(instance.patch, group);
      const bool is_taken = access.mode == Mode::read || access.mode == Mode::update;
      if (!is_taken || !is_on_grid(centring)) return;
      if (!access.of_previous_step && !written_.has(*access.label, instance.patch, group, FieldBuffer::current)) return;
      fields = true;
      if (group >= 0) groups.set(static_cast<std::size_t>(group));
    });
    if (sparsity == Sparsity::no_pair) return groups.count() < 2;
    return !fields && (sparsity == Sparsity::no_fields || !particles);
  }

  void write(const Instance& instance)
  {
    for_each_field(instance, [&](const Access& access, int group) {
      if (access.mode != Mode::read) written_.add(*access.label, instance.patch, group, buffer_of(access));
    });
  }

  /// Marks the buffers of this patch as written to where a neighbour's are.
  void pass(const Instance& instance, FieldBuffer from)
  {
    for (const Label* label : instance.labels) {
      for (const auto& [patch, shift] : graph_.layout()[instance.patch].images) {
        if (!written_.has(*label, patch, instance.group, from)) continue;
        written_.add(*label, instance.patch, instance.group, FieldBuffer::current);
        break;
      }
    }
  }

  const TaskGraph& graph_;
  std::span<const std::size_t> n_particles_;
  WrittenBuffers& written_;
};

double n_values(const LabelUse& use, const Patch& patch, int halo, int dimension)
{
  const IndexBox& own = use.label->centring() == Centring::node ? patch.nodes : patch.cells;
  return static_cast<double>(grown(own, halo, dimension).size());
}

/// Bytes of a label for one group on all patches together; of a reduction or a global, its value and the parts that it
/// is made of, on one rank.
double bytes_of(const LabelUse& use, const PatchLayout& layout, int n_groups, int halo,
                std::span<const std::size_t> n_particles, const WrittenBuffers& written)
{
  const auto value_bytes = static_cast<double>(use.label->value_bytes());
  const Centring centring = use.label->centring();
  if (has_one_value(centring)) {
    const std::size_t n_parts = centring == Centring::reduction ? written.n_buffers(*use.label) : 0;
    return (int{use.state} + int{use.computed} + static_cast<double>(n_parts)) * value_bytes;
  }
  double sum = 0;
  for (const Patch& patch : layout) {
    if (centring == Centring::particle) {
      const int n_buffers = int{use.state} + int{use.computed || !use.state};
      sum += n_buffers * static_cast<double>(n_particles[static_cast<std::size_t>(patch.id * n_groups + use.group)]);
    } else if (use.state || use.filled) {
      const int n_buffers = int{use.state} + int{use.computed} + int{use.accumulated};
      sum += n_buffers * n_values(use, patch, halo, layout.grid().dimension);
    } else {
      const auto n_buffers = static_cast<double>(written.n_buffers(*use.label, patch.id, use.group));
      sum += n_buffers * n_values(use, patch, halo, layout.grid().dimension);
    }
  }
  return sum * value_bytes;
}

/// Bytes of the node and cell fields that messages bring: they are stored in full, as on the rank that they come from.
double bytes_of_copies(const TaskGraph& graph, int halo, const WrittenBuffers& written)
{
  const PatchLayout& layout = graph.layout();
  std::set<std::tuple<int, const Label*, int, int, FieldBuffer>> copies;
  double bytes = 0;
  for (const Message& message : graph.messages()) {
    for (const MessagePart& part : message.parts) {
      const bool is_stored = message.purpose != InstanceKind::receive_particles && is_on_grid(part.label->centring()) &&
                             written.has(*part.label, part.from_patch, part.group, part.buffer);
      if (!is_stored) continue;
      if (!copies.emplace(message.to_rank, part.label, part.from_patch, part.group, part.buffer).second) continue;
      const LabelUse use{part.label};
      bytes += n_values(use, layout[part.from_patch], halo, layout.grid().dimension) *
               static_cast<double>(part.label->value_bytes());
    }
  }
  return bytes;
}

}  // namespace

double forecast_bytes(std::span<const TaskGraph* const> graphs, std::span<const std::size_t> n_particles, int n_ranks)
{
  const PatchLayout& layout = graphs.front()->layout();
  const int n_groups = graphs.front()->n_groups();
  const std::vector<LabelUse> uses = label_uses(graphs);
  WrittenBuffers written(uses, layout.size(), n_groups);
  for (const TaskGraph* graph : graphs) DryStep(*graph, n_particles, written).go();
  const int halo = storage_halo(graphs);
  double bytes = 0;
  for (const LabelUse& use : uses) {
    const int n_times = has_one_value(use.label->centring()) ? n_ranks : 1;
    bytes += n_times * bytes_of(use, layout, n_groups, halo, n_particles, written);
  }
  for (const TaskGraph* graph : graphs) bytes += bytes_of_copies(*graph, halo, written);
  return bytes;
}

}  // namespace tamp::runtime
