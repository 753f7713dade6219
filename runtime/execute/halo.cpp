#include "runtime/execute/halo.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace tamp::runtime
{

namespace
{

/// Calls `row(offset in a, offset in b, length)` for every row of `box`, in bytes of two fields' storage.
template <class Row>
void for_each_row(const IndexBox& box, const Field& a, const Field& b, const Row& row)
{
  if (box.empty()) return;
  const std::size_t size = a.label->value_bytes();
  const auto offset = [&](const Field& f, int j, int k) {
    const auto strides = f.box.strides();
    return static_cast<std::size_t>((box.lower[0] - f.box.lower[0]) + strides[1] * (j - f.box.lower[1]) +
                                    strides[2] * (k - f.box.lower[2])) *
           size;
  };
  for (int k = box.lower[2]; k < box.upper[2]; ++k) {
    for (int j = box.lower[1]; j < box.upper[1]; ++j) {
      row(offset(a, j, k), offset(b, j, k), static_cast<std::size_t>(box.extent(0)) * size);
    }
  }
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

}  // namespace tamp::runtime
