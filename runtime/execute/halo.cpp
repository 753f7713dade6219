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

IndexBox patch_box(const Label& label, const Patch& patch)
{
  return label.centring() == Centring::node ? patch.nodes : patch.cells;
}

}  // namespace

void sum_halo(Warehouse& warehouse, const Label& label, int patch, int group, int halo)
{
  const PatchLayout& layout = warehouse.layout();
  const int dimension = layout.grid().dimension;
  Field& total = warehouse.field(label, patch, group);
  std::memset(total.current_buffer.data(), 0, total.n_bytes());

  const IndexBox box = grown(patch_box(label, layout[patch]), halo, dimension);
  const auto add_part = [&](int from) {
    const Field& part = warehouse.field(label, from, group);
    const IndexBox shared = intersection(box, grown(patch_box(label, layout[from]), halo, dimension));
    for_each_row(shared, total, part, [&](std::size_t to_offset, std::size_t from_offset, std::size_t bytes) {
      auto* into = reinterpret_cast<double*>(total.current_buffer.data() + to_offset);
      const auto* add = reinterpret_cast<const double*>(part.part_buffer.data() + from_offset);
      for (std::size_t i = 0; i < bytes / sizeof(double); ++i) into[i] += add[i];
    });
  };
  const auto& neighbours = layout[patch].neighbours;
  const auto higher = std::upper_bound(neighbours.begin(), neighbours.end(), patch);
  std::for_each(neighbours.begin(), higher, add_part);
  add_part(patch);
  std::for_each(higher, neighbours.end(), add_part);
}

void fill_halo(Warehouse& warehouse, const Label& label, int patch, int group, int halo, FieldBuffer buffer)
{
  const PatchLayout& layout = warehouse.layout();
  Field& to = warehouse.field(label, patch, group);
  const IndexBox own = patch_box(label, layout[patch]);
  const IndexBox box = grown(own, halo, layout.grid().dimension);
  for (const int other : layout[patch].neighbours) {
    const Field& from = warehouse.field(label, other, group);
    // Seam nodes are both patches' own: a row is copied only where it lies outside of this patch.
    for_each(intersection(box, patch_box(label, layout[other])), [&](const Index& i) {
      if (own.contains(i)) return;
      for_each_row(IndexBox{i, {i[0] + 1, i[1] + 1, i[2] + 1}}, to, from,
                   [&](std::size_t to_offset, std::size_t from_offset, std::size_t bytes) {
                     std::memcpy(to.buffer(buffer).data() + to_offset, from.buffer(buffer).data() + from_offset, bytes);
                   });
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
