#include "runtime/execute/halo.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace tamp::runtime
{

namespace
{

/// Where the row of a box at (j, k) begins in a field's storage, in bytes.
std::size_t row_offset(const Field& f, const IndexBox& box, int j, int k)
{
  const auto strides = f.box.strides();
  return static_cast<std::size_t>((box.lower[0] - f.box.lower[0]) + strides[1] * (j - f.box.lower[1]) +
                                  strides[2] * (k - f.box.lower[2])) *
         f.label->value_bytes();
}

std::size_t row_bytes(const Field& f, const IndexBox& box)
{
  return static_cast<std::size_t>(box.extent(0)) * f.label->value_bytes();
}

/// Calls `row(j, k)` for every row of `box`.
template <class Row>
void for_each_row(const IndexBox& box, const Row& row)
{
  if (box.empty()) return;
  for (int k = box.lower[2]; k < box.upper[2]; ++k) {
    for (int j = box.lower[1]; j < box.upper[1]; ++j) row(j, k);
  }
}

/// Calls `row(offset in a, offset in b, length)` for every row of `box`, in bytes of two fields' storage.
template <class Row>
void for_each_row(const IndexBox& box, const Field& a, const Field& b, const Row& row)
{
  for_each_row(box, [&](int j, int k) { row(row_offset(a, box, j, k), row_offset(b, box, j, k), row_bytes(a, box)); });
}

/// What of `a` lies outside of `b`, in boxes that do not overlap.
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

IndexBox patch_box(const Label& label, const Patch& patch)
{
  return label.centring() == Centring::node ? patch.nodes : patch.cells;
}

}  // namespace

BoundHalo bind_halo_sum(Warehouse& warehouse, const Label& label, int patch, int group, int halo)
{
  const PatchLayout& layout = warehouse.layout();
  const auto box_of = [&](int p) { return grown(patch_box(label, layout[p]), halo, layout.grid().dimension); };
  std::vector<int> sources = layout[patch].neighbours;
  sources.insert(std::upper_bound(sources.begin(), sources.end(), patch), patch);
  BoundHalo bound{&warehouse.field(label, patch, group), {}};
  for (const int from : sources) {
    bound.parts.push_back({&warehouse.field(label, from, group), intersection(box_of(patch), box_of(from))});
  }
  return bound;
}

bool sum_halo(const BoundHalo& halo)
{
  halo.to->make_zero(FieldBuffer::current);
  std::byte* const sums = halo.to->current_buffer.data();
  const AddValues add = halo.to->label->add();
  bool any = false;
  for (const auto& [from, box] : halo.parts) {
    if (from->is_zero(FieldBuffer::part)) continue;
    any = true;
    const std::byte* const values = from->part_buffer.data();
    for_each_row(box, *halo.to, *from, [&](std::size_t to_offset, std::size_t from_offset, std::size_t bytes) {
      add(sums + to_offset, values + from_offset, bytes);
    });
  }
  if (any) halo.to->note_written(FieldBuffer::current);
  return any;
}

BoundHalo bind_halo_fill(Warehouse& warehouse, const Label& label, int patch, int group, int halo)
{
  const PatchLayout& layout = warehouse.layout();
  const IndexBox own = patch_box(label, layout[patch]);
  const IndexBox box = grown(own, halo, layout.grid().dimension);
  BoundHalo bound{&warehouse.field(label, patch, group), {}};
  for (const int other : layout[patch].neighbours) {
    const Field& from = warehouse.field(label, other, group);
    // Seam nodes are both patches' own, and stay as they are.
    for (const IndexBox& piece : difference(intersection(box, patch_box(label, layout[other])), own)) {
      bound.parts.push_back({&from, piece});
    }
  }
  return bound;
}

void fill_halo(const BoundHalo& halo, FieldBuffer buffer)
{
  std::byte* const to = halo.to->buffer(buffer).data();
  for (const auto& [from, box] : halo.parts) {
    const std::byte* const values = from->buffer(buffer).data();
    for_each_row(box, *halo.to, *from, [&](std::size_t to_offset, std::size_t from_offset, std::size_t bytes) {
      std::memcpy(to + to_offset, values + from_offset, bytes);
    });
  }
}

std::byte* copy_out(const Field& field, FieldBuffer buffer, const IndexBox& box, std::byte* to)
{
  const std::byte* values = field.buffer(buffer).data();
  if (field.label->centring() == Centring::reduction) return std::copy_n(values, field.n_bytes(), to);
  for_each_row(
      box, [&](int j, int k) { to = std::copy_n(values + row_offset(field, box, j, k), row_bytes(field, box), to); });
  return to;
}

const std::byte* copy_in(Field& field, FieldBuffer buffer, const IndexBox& box, const std::byte* from)
{
  std::byte* values = field.buffer(buffer).data();
  const auto take = [&](std::byte* to, std::size_t n) {
    std::memcpy(to, from, n);
    from += n;
  };
  if (field.label->centring() == Centring::reduction) {
    take(values, field.n_bytes());
  } else {
    for_each_row(box, [&](int j, int k) { take(values + row_offset(field, box, j, k), row_bytes(field, box)); });
  }
  return from;
}

}  // namespace tamp::runtime
