#include "runtime/warehouse/warehouse.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace tamp::runtime
{

namespace
{

/// One use of each label and group over all graphs: state and computed where any graph says so.
std::vector<LabelUse> merged_uses(std::span<const TaskGraph* const> graphs)
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
      }
    }
  }
  return merged;
}

}  // namespace

Warehouse::Warehouse(std::span<const TaskGraph* const> graphs, int rank)
    : layout_(&graphs.front()->layout()), rank_(rank), n_groups_(graphs.front()->n_groups())
{
  const auto n_places = static_cast<std::size_t>(layout_->size() * n_groups_);
  counts_.assign(n_places, 0);
  particle_fields_.resize(n_places);
  fields_of_patch_.resize(static_cast<std::size_t>(layout_->size()));
  int halo = 0;
  for (const TaskGraph* graph : graphs) halo = std::max(halo, graph->storage_halo());
  for (const LabelUse& use : merged_uses(graphs)) {
    // A reduction has a part on every patch and for every group, and the whole, as a global, at (-1, -1): only that is
    // accumulated.
    if (has_one_value(use.label->centring())) add_field(use, -1, halo);
    if (use.label->centring() == Centring::global) continue;
    for (const Patch& patch : *layout_) {
      LabelUse part = use;
      part.state &= use.label->centring() != Centring::reduction;
      add_field(part, patch.id, halo);
      if (use.label->centring() != Centring::reduction) continue;
      for (int g = 0; g < n_groups_; ++g) {
        part.group = g;
        add_field(part, patch.id, halo);
      }
    }
  }
  for (const TaskGraph* graph : graphs) reserve_copies(*graph);
}

/// Where messages put what they bring of other ranks' patches: tasks find it there as they find their own.
void Warehouse::reserve_copies(const TaskGraph& graph)
{
  for (const Message& message : graph.messages()) {
    if (message.to_rank != rank_ || message.purpose == InstanceKind::receive_particles) continue;
    for (const MessagePart& part : message.parts) {
      Field& f = field(*part.label, part.from_patch, part.group);
      f.buffer(part.buffer).reserve(f.n_bytes());
      // The two buffers of a state change places with every step.
      if (f.state && !f.carried) {
        f.previous_buffer.reserve(f.n_bytes());
        f.current_buffer.reserve(f.n_bytes());
      }
    }
  }
}

void Warehouse::add_field(const LabelUse& use, int patch, int halo)
{
  Field& f = fields_.emplace_back();
  f.label = use.label;
  f.patch = patch;
  f.group = use.group;
  f.state = use.state;
  f.computed = use.computed;
  f.accumulated = use.accumulated;
  f.carried = use.state && !use.computed;
  LedgerEntry& entry = ledger_.entry(use.label->name());
  f.previous_buffer = Buffer(ledger_, entry);
  f.current_buffer = Buffer(ledger_, entry);
  f.part_buffer = Buffer(ledger_, entry);
  const Centring centring = use.label->centring();
  if (centring == Centring::particle) {
    const auto place = static_cast<std::size_t>(patch * n_groups_ + use.group);
    f.n_particles = &counts_[place];
    particle_fields_[place].push_back(&f);
  } else if (is_on_grid(centring)) {
    const Patch& p = (*layout_)[patch];
    f.box = grown(centring == Centring::node ? p.nodes : p.cells, halo, layout_->grid().dimension);
    f.reserve_rows();
  }
  reserve(f);
  // A part that no task reduces must not count.
  if (centring == Centring::reduction) use.label->reduction()->reset(f.current_buffer.data());
  if (centring == Centring::reduction && f.state) use.label->reduction()->reset(f.previous_buffer.data());
  lookup_[{use.label, patch, use.group}] = &f;
  if (patch >= 0) fields_of_patch_[static_cast<std::size_t>(patch)].push_back(&f);
}

/// Makes room for the values of this rank's patches, and for the parts of a reduction from all.
void Warehouse::reserve(Field& f) const
{
  const bool reduction = f.label->centring() == Centring::reduction;
  const bool local = f.patch < 0 || is_local((*layout_)[f.patch]);
  if (f.state && local) f.previous_buffer.reserve(f.n_bytes());
  if (reduction || (f.computed && local)) f.current_buffer.reserve(f.n_bytes());
  if (f.accumulated && local) f.part_buffer.reserve(f.n_bytes());
}

/// A patch of which nothing is kept but the parts of reductions, which come from every rank.
void Warehouse::release(int patch)
{
  for (int g = 0; g < n_groups_; ++g) counts_[static_cast<std::size_t>(patch * n_groups_ + g)] = 0;
  for (Field* f : fields_of_patch_[static_cast<std::size_t>(patch)]) {
    if (f->label->centring() != Centring::reduction) f->release();
  }
}

/// What a patch holds between steps: its particles and the state on it.
void Warehouse::send(int patch, int rank, const Communicator& communicator)
{
  for (int g = 0; g < n_groups_; ++g) {
    const std::size_t n = n_particles(patch, g);
    communicator.send(rank, std::as_bytes(std::span(&n, 1)));
  }
  for (const Field* f : fields_of_patch_[static_cast<std::size_t>(patch)]) {
    if (f->state) communicator.send(rank, {f->previous_buffer.data(), f->n_bytes()});
  }
}

void Warehouse::receive(int patch, int rank, const Communicator& communicator)
{
  for (int g = 0; g < n_groups_; ++g) {
    std::size_t n = 0;
    communicator.receive(rank, std::as_writable_bytes(std::span(&n, 1)));
    set_n_particles(patch, g, n);
  }
  for (Field* f : fields_of_patch_[static_cast<std::size_t>(patch)]) {
    reserve(*f);
    if (f->state) communicator.receive(rank, {f->previous_buffer.data(), f->n_bytes()});
  }
}

/// All ranks go through the patches in one order, so that each transfer finds both of its ends.
void Warehouse::deal(std::span<const TaskGraph* const> graphs, const Communicator& communicator)
{
  const std::vector<int> old_ranks = layout_->ranks();
  layout_ = &graphs.front()->layout();
  for (const Patch& patch : *layout_) {
    const int from = old_ranks[static_cast<std::size_t>(patch.id)];
    const bool stays = from == rank_ && patch.rank == rank_;
    if (from == rank_ && !stays) send(patch.id, patch.rank, communicator);
    if (!stays) release(patch.id);
    if (patch.rank == rank_ && !stays) receive(patch.id, from, communicator);
  }
  for (const TaskGraph* graph : graphs) reserve_copies(*graph);
}

std::size_t Warehouse::forecast_bytes() const
{
  std::size_t bytes = 0;
  for (const Field& f : fields_) {
    const bool has_current = f.n_particles != nullptr ? !f.carried : f.current_buffer.capacity() > 0;
    const bool has_part = f.part_buffer.capacity() > 0;
    const bool has_previous = f.n_particles != nullptr ? f.state : f.previous_buffer.capacity() > 0;
    bytes += f.n_bytes() * (std::size_t{has_previous} + std::size_t{has_current} + std::size_t{has_part});
  }
  return bytes;
}

double Warehouse::forecast_bytes(std::span<const TaskGraph* const> graphs, std::span<const std::size_t> n_particles)
{
  const PatchLayout& layout = graphs.front()->layout();
  int halo = 0;
  for (const TaskGraph* graph : graphs) halo = std::max(halo, graph->storage_halo());
  double n_nodes = 0, n_cells = 0;
  for (const Patch& patch : layout) {
    n_nodes += static_cast<double>(grown(patch.nodes, halo, layout.grid().dimension).size());
    n_cells += static_cast<double>(grown(patch.cells, halo, layout.grid().dimension).size());
  }
  double bytes = 0;
  for (const LabelUse& use : merged_uses(graphs)) {
    const Centring centring = use.label->centring();
    if (has_one_value(centring)) {
      // A reduction has parts of all patches, of each group and of none, beside the whole.
      const double n_parts = centring == Centring::global ? 0 : layout.size() * (graphs.front()->n_groups() + 1.0);
      bytes += (int{use.state} + int{use.computed} + n_parts) * static_cast<double>(use.label->value_bytes());
      continue;
    }
    const bool of_particles = centring == Centring::particle;
    const int n_buffers =
        int{use.state} + int{use.computed || (of_particles && !use.state)} + int{use.accumulated && !of_particles};
    const double n_values = of_particles ? static_cast<double>(n_particles[static_cast<std::size_t>(use.group)])
                            : centring == Centring::node ? n_nodes
                                                         : n_cells;
    bytes += n_buffers * n_values * static_cast<double>(use.label->value_bytes());
  }
  return bytes;
}

std::size_t Warehouse::n_particles(int group) const
{
  std::size_t n = 0;
  for (const Patch& patch : *layout_) n += n_particles(patch.id, group);
  return n;
}

void Warehouse::set_n_particles(int patch, int group, std::size_t n)
{
  counts_[static_cast<std::size_t>(patch * n_groups_ + group)] = n;
  for (Field* f : particle_fields(patch, group)) {
    if (f->state) f->previous_buffer.fit(f->n_bytes());
    if (!f->carried) f->current_buffer.fit(f->n_bytes());
  }
}

void Warehouse::advance()
{
  for (Field& f : fields_) {
    if (!f.state || f.carried) continue;
    if (f.label->centring() == Centring::reduction) {
      f.label->reduction()->combine(f.previous_buffer.data(), f.current_buffer.data());
    } else {
      f.previous_buffer.swap(f.current_buffer);
    }
  }
}

Field& Warehouse::field(const Label& label, int patch, int group)
{
  const auto found = lookup_.find({&label, patch, group});
  if (found == lookup_.end()) throw std::out_of_range("no graph uses the label '" + label.name() + "'");
  return *found->second;
}

const std::vector<Field*>& Warehouse::particle_fields(int patch, int group) const
{
  return particle_fields_[static_cast<std::size_t>(patch * n_groups_ + group)];
}

const std::size_t& Warehouse::count(int patch, int group) const
{
  return counts_[static_cast<std::size_t>(patch * n_groups_ + group)];
}

}  // namespace tamp::runtime
