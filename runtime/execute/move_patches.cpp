#include "runtime/execute/move_patches.hpp"

#include <cstring>

namespace tamp::runtime
{

namespace
{

std::vector<Field*> state_of(Warehouse& warehouse, int patch)
{
  std::vector<Field*> fields;
  for (Field& f : warehouse.fields()) {
    if (f.patch == patch && f.state) fields.push_back(&f);
  }
  return fields;
}

void write_patch(Warehouse& warehouse, int patch, std::vector<std::byte>& bytes)
{
  const auto add = [&](const void* first, std::size_t n) {
    const auto* from = static_cast<const std::byte*>(first);
    bytes.insert(bytes.end(), from, from + n);
  };
  for (int g = 0; g < warehouse.n_groups(); ++g) {
    const std::size_t n = warehouse.n_particles(patch, g);
    add(&n, sizeof n);
  }
  for (const Field* f : state_of(warehouse, patch)) add(f->previous_buffer.data(), f->n_bytes());
}

const std::byte* read_patch(Warehouse& warehouse, int patch, const std::byte* from)
{
  for (int g = 0; g < warehouse.n_groups(); ++g) {
    std::size_t n = 0;
    std::memcpy(&n, from, sizeof n);
    from += sizeof n;
    warehouse.set_n_particles(patch, g, n);
  }
  for (Field* f : state_of(warehouse, patch)) {
    if (f->n_bytes() > 0) std::memcpy(f->previous_buffer.data(), from, f->n_bytes());
    from += f->n_bytes();
  }
  return from;
}

/// Globals and accumulated reductions are on every rank already.
void copy_single_values(Warehouse& from, Warehouse& to)
{
  for (Field* f : state_of(from, -1)) {
    std::memcpy(to.field(*f->label, -1, -1).previous_buffer.data(), f->previous_buffer.data(), f->n_bytes());
  }
}

}  // namespace

void move_patches(Warehouse& from, Warehouse& to, const Communicator& communicator)
{
  copy_single_values(from, to);
  const auto rank_of = [](const Warehouse& w, int patch) { return static_cast<std::size_t>(w.layout()[patch].rank); };
  std::vector<std::vector<std::byte>> to_each(static_cast<std::size_t>(communicator.size()));
  for (const Patch& patch : from.layout()) {
    if (from.is_local(patch)) write_patch(from, patch.id, to_each[rank_of(to, patch.id)]);
  }
  const std::vector<std::vector<std::byte>> from_each = communicator.exchange(to_each);
  std::vector<const std::byte*> at;
  at.reserve(from_each.size());
  for (const auto& bytes : from_each) at.push_back(bytes.data());
  for (const Patch& patch : to.layout()) {
    if (!to.is_local(patch)) continue;
    const std::byte*& next = at[rank_of(from, patch.id)];
    next = read_patch(to, patch.id, next);
  }
}

}  // namespace tamp::runtime
