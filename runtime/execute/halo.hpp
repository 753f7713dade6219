#pragma once

#include <vector>

#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// A field of a patch and what it takes from its own and others' fields, looked up once.
struct BoundHalo {
  struct Part {
    const Field* from;
    /// In the indices of the field that takes it; those of `from` are less by the shift.
    IndexBox box;
    Index shift;
  };

  Field* to;
  std::vector<Part> parts;
};

/// For the values of a patch with `halo` layers: the parts of the patch and its neighbours, in the order of its images.
BoundHalo bind_halo_sum(Warehouse& warehouse, const Label& label, int patch, int group, int halo);

/// Adds all parts into the current values: the same sums on both sides of every seam, bit for bit. Parts known to be
/// zero, and rows that are, are left out, which changes no bit of a sum that starts at zero; false if no part was left.
bool sum_halo(const BoundHalo& halo);

/// Binds the copy of the neighbours' values into the `halo` layers around a patch.
BoundHalo bind_halo_fill(Warehouse& warehouse, const Label& label, int patch, int group, int halo);

/// Copies the values.
void fill_halo(const BoundHalo& halo, FieldBuffer buffer);

/// Copies what a field holds in `box` (all of a reduction) to bytes in a row; returns the end of them.
std::byte* copy_out(const Field& field, FieldBuffer buffer, const IndexBox& box, std::byte* to);

/// The reverse.
const std::byte* copy_in(Field& field, FieldBuffer buffer, const IndexBox& box, const std::byte* from);

}  // namespace tamp::runtime
