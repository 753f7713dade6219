#include "runtime/execute/halo.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace tamp::runtime
{

namespace
{

/// Where the value of a node or cell stands in a field's storage, in bytes.
std::size_t offset_of(const Field& f, const Index& i)
{
  const auto strides = f.box.strides();
  return static_cast<std::size_t>((i[0] - f.box.lower[0]) + strides[1] * (i[1] - f.box.lower[1]) +
                                  strides[2] * (i[2] - f.box.lower[2])) *
         f.label->value_bytes();
}

std::size_t row_bytes(const Field& f, const IndexBox& box)
{
  return static_cast<std::size_t>(box.extent(0)) * f.label->value_bytes();
}

/// Calls `row(first)` for every row of `box`.
template <class Row>
void for_each_row(const IndexBox& box, const Row& row)
{
  if (box.empty()) return;
  for (int k = box.lower[2]; k < box.upper[2]; ++k) {
    for (int j = box.lower[1]; j < box.upper[1]; ++j) row(Index{box.lower[0], j, k});
  }
}

/// Calls `row(offset in to, offset in from, length)` for every row of a part, in bytes of the fields' storage.
template <class Row>
void for_each_row(const Field& to, const BoundHalo::Part& part, const Row& row)
{
  const Index& shift = part.shift;
  for_each_row(part.box, [&](const Index& i) {
    const Index there{i[0] - shift[0], i[1] - shift[1], i[2] - shift[2]};
    row(offset_of(to, i), offset_of(*part.from, there), row_bytes(to, part.box));
  });
}

/// The part of `a` outside of `b`, in boxes that do not overlap.
std::vector<IndexBox> difference(IndexBox a, const IndexBox& b)
{
  std::vector<IndexBox> pieces;
  const auto add = [&](const IndexBox& piece) {
    if (!piece.empty()) pieces.push_back(piece);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    IndexBox below = a, above = a;
    below.upper[axis] = std::min(a.upper[axis], b.lower[axis]);
    above.lower[axis] = std::max(a.lower[axis], b.upper[axis]);
    add(below);
    add(above);
    a.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
    a.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
  }
  return pieces;
}

/// Whether all bits are zero.
bool is_zero(const std::byte* bytes, std::size_t n)
{
  constexpr std::size_t block = 64;
  std::byte any{0};
  while (n >= block && any == std::byte{0}) {
    for (std::size_t k = 0; k < block; ++k) any |= bytes[k];
    bytes += block;
    n -= block;
  }
  for (std::size_t k = 0; k < n; ++k) any |= bytes[k];
  return any == std::byte{0};
}

IndexBox patch_box(const Label& label, const Patch& patch)
{
  return label.centring() == Centring::node ? patch.nodes : patch.cells;
}

}  // namespace

BoundHalo bind_halo_sum(Warehouse& warehouse, const Label& label, int patch, int group, int halo)
{
  const PatchLayout& layout = warehouse.layout();
  const auto box_of = [&](int p) { return grown(patch_box(label, layout[p]), halo, layout.grid().dimension); };
  BoundHalo bound{&warehouse.field(label, patch, group), {}};
  for (const auto& [from, shift] : layout[patch].images) {
    const IndexBox shared = intersection(box_of(patch), moved(box_of(from), shift));
    bound.parts.push_back({&warehouse.field(label, from, group), shared, shift});
  }
  return bound;
}

bool sum_halo(const BoundHalo& halo)
{
  Field& to = *halo.to;
  to.make_zero(FieldBuffer::current);
  std::byte* sums = nullptr;
  const AddValues add = to.label->add();
  std::vector<bool>* rows = nullptr;
  for (const BoundHalo::Part& part : halo.parts) {
    if (part.from->is_zero(FieldBuffer::part)) continue;
    if (rows == nullptr) {
      sums = to.written_values(FieldBuffer::current);
      rows = &to.only_written_rows(FieldBuffer::current);
    }
    // This patch's own part, if all of it passes by here.
    const bool is_own = part.from == &to && part.box == to.box && part.shift == Index{0, 0, 0};
    std::vector<bool>* const own_rows = is_own ? &to.only_written_rows(FieldBuffer::part) : nullptr;
    const std::byte* const values = part.from->part_buffer.data();
    for_each_row(to, part, [&](std::size_t to_offset, std::size_t from_offset, std::size_t bytes) {
      if (is_zero(values + from_offset, bytes)) return;
      add(sums + to_offset, values + from_offset, bytes);
      (*rows)[to_offset / to.row_bytes()] = true;
      if (own_rows != nullptr) (*own_rows)[from_offset / to.row_bytes()] = true;
    });
  }
  return rows != nullptr;
}

BoundHalo bind_halo_fill(Warehouse& warehouse, const Label& label, int patch, int group, int halo)
{
  const PatchLayout& layout = warehouse.layout();
  const IndexBox own = patch_box(label, layout[patch]);
  const IndexBox box = grown(own, halo, layout.grid().dimension);
  BoundHalo bound{&warehouse.field(label, patch, group), {}};
  for (const auto& [other, shift] : layout[patch].images) {
    const Field& from = warehouse.field(label, other, group);
    // Seam nodes are both patches' own, and stay as they are.
    for (const IndexBox& piece : difference(intersection(box, moved(patch_box(label, layout[other]), shift)), own)) {
      bound.parts.push_back({&from, piece, shift});
    }
  }
  return bound;
}

void fill_halo(const BoundHalo& halo, FieldBuffer buffer)
{
  std::byte* const to = halo.to->buffer(buffer).data();
  for (const BoundHalo::Part& part : halo.parts) {
    const std::byte* const values = part.from->buffer(buffer).data();
    for_each_row(*halo.to, part, [&](std::size_t to_offset, std::size_t from_offset, std::size_t bytes) {
      std::memcpy(to + to_offset, values + from_offset, bytes);
    });
  }
}

std::byte* copy_out(const Field& field, FieldBuffer buffer, const IndexBox& box, std::byte* to)
{
  const std::byte* values = field.values(buffer);
  if (field.label->centring() == Centring::reduction) return std::copy_n(values, field.n_bytes(), to);
  for_each_row(box, [&](const Index& i) { to = std::copy_n(values + offset_of(field, i), row_bytes(field, box), to); });
  return to;
}

const std::byte* copy_in(Field& field, FieldBuffer buffer, const IndexBox& box, const std::byte* from)
{
  std::byte* const values = field.written_values(buffer);
  const auto take = [&](std::byte* to, std::size_t n) {
    std::memcpy(to, from, n);
    from += n;
  };
  if (field.label->centring() == Centring::reduction) {
    take(values, field.n_bytes());
  } else {
    for_each_row(box, [&](const Index& i) { take(values + offset_of(field, i), row_bytes(field, box)); });
  }
  return from;
}

}  // namespace tamp::runtime
