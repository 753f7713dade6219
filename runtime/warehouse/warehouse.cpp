#include "runtime/warehouse/warehouse.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "runtime/graph/graph_error.hpp"

namespace tamp::runtime
{

Warehouse::Warehouse(std::span<const TaskGraph* const> graphs, int rank)
    : layout_(&graphs.front()->layout()), rank_(rank), n_groups_(graphs.front()->n_groups())
{
  const auto n_places = static_cast<std::size_t>(layout_->size() * n_groups_);
  counts_.assign(n_places, 0);
  particle_fields_.resize(n_places);
  fields_of_patch_.resize(static_cast<std::size_t>(layout_->size()));
  const int halo = storage_halo(graphs);
  zeros_ = Buffer(ledger_.entry("zeros"));
  for (const LabelUse& use : label_uses(graphs)) {
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

/// Reserves the fields in which messages store the data of other ranks' patches; tasks read them there like those of
/// their own.
void Warehouse::reserve_copies(const TaskGraph& graph)
{
  for (const Message& message : graph.messages()) {
    if (message.to_rank != rank_ || message.purpose == InstanceKind::receive_particles) continue;
    for (const MessagePart& part : message.parts) {
      Field& f = field(*part.label, part.from_patch, part.group);
      if (f.on_demand) continue;
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
  f.previous_buffer = Buffer(entry);
  f.current_buffer = Buffer(entry);
  f.part_buffer = Buffer(entry);
  const Centring centring = use.label->centring();
  if (centring == Centring::particle) {
    const auto place = static_cast<std::size_t>(patch * n_groups_ + use.group);
    f.n_particles = &counts_[place];
    particle_fields_[place].push_back(&f);
  } else if (is_on_grid(centring)) {
    const Patch& p = (*layout_)[patch];
    f.box = grown(centring == Centring::node ? p.nodes : p.cells, halo, layout_->grid().dimension);
  }
  f.tracks_zero = patch >= 0 && !f.state && centring != Centring::particle;
  if (f.tracks_zero && !use.filled) store_on_demand(f);
  if (f.state && !f.carried) changing_.push_back(&f);
  reserve(f);
  const bool is_whole = centring == Centring::reduction && patch < 0;
  if (is_whole) use.label->reduction()->reset(f.current_buffer.data());
  if (is_whole && f.state) use.label->reduction()->reset(f.previous_buffer.data());
  std::vector<Field*>& of_label = lookup_[use.label];
  of_label.resize(place(layout_->size(), -1));
  of_label[place(patch, use.group)] = &f;
  if (patch >= 0) fields_of_patch_[static_cast<std::size_t>(patch)].push_back(&f);
}

void Warehouse::store_on_demand(Field& f)
{
  f.on_demand = true;
  on_demand_.push_back(&f);
  if (!is_on_grid(f.label->centring())) return;
  zeros_.reserve(f.n_bytes());
  f.zeros = &zeros_;
}

/// Makes room for the values of this rank's patches, and for the whole of a reduction.
void Warehouse::reserve(Field& f) const
{
  if (f.on_demand) return;
  const bool local = f.patch < 0 || is_local((*layout_)[f.patch]);
  if (f.state && local) f.previous_buffer.reserve(f.n_bytes());
  const bool is_reduction = f.label->centring() == Centring::reduction;
  if ((is_reduction || f.computed) && local) f.current_buffer.reserve(f.n_bytes());
  if (f.accumulated && local) f.part_buffer.reserve(f.n_bytes());
}

/// Frees the fields of a patch, but for the parts of reductions, which come from every rank.
void Warehouse::release(int patch)
{
  for (int g = 0; g < n_groups_; ++g) counts_[static_cast<std::size_t>(patch * n_groups_ + g)] = 0;
  for (Field* f : fields_of_patch_[static_cast<std::size_t>(patch)]) {
    if (f->label->centring() != Centring::reduction) f->release();
  }
}

/// Sends what a patch holds between steps: its particles and its state.
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
  expect_ranks(graphs.front()->layout(), communicator.size());
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
  for (Field* f : changing_) {
    if (f->label->centring() == Centring::reduction) {
      f->label->reduction()->combine(f->previous_buffer.data(), f->current_buffer.data());
    } else {
      f->previous_buffer.swap(f->current_buffer);
    }
  }
  constexpr long seldom = 64;
  if (++n_advances_ % seldom != 0) return;
  for (Field* f : on_demand_) {
    if (f->current_buffer.capacity() + f->part_buffer.capacity() > 0) f->release_if_idle();
  }
}

Field& Warehouse::field(const Label& label, int patch, int group)
{
  const auto found = lookup_.find(&label);
  Field* const field = found == lookup_.end() ? nullptr : found->second.at(place(patch, group));
  if (field == nullptr) throw std::out_of_range("no graph uses the label '" + label.name() + "'");
  return *field;
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
