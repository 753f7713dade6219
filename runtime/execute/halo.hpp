#pragma once

#include "runtime/data/warehouse.hpp"

namespace tamp::runtime
{

/// Adds the parts of a patch and its neighbours, in the order of their ids, into the current values of `label` on the
/// patch with `halo` layers: the same sums on both sides of every seam, bit for bit.
void sum_halo(Warehouse& warehouse, const Label& label, int patch, int group, int halo);

/// Copies neighbours' values into the `halo` layers around a patch.
void fill_halo(Warehouse& warehouse, const Label& label, int patch, int group, int halo, FieldBuffer buffer);

/// Copies what a field holds in `box` (all of a reduction) to bytes in a row; returns the end of them.
std::byte* copy_out(const Field& field, FieldBuffer buffer, const IndexBox& box, std::byte* to);

/// The reverse.
const std::byte* copy_in(Field& field, FieldBuffer buffer, const IndexBox& box, const std::byte* from);

}  // namespace tamp::runtime
