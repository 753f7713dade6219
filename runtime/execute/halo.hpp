#pragma once

#include "runtime/data/warehouse.hpp"

namespace tamp::runtime
{

/// Adds the parts of a patch and its neighbours, in the order of their ids, into the current values of `label` on the
/// patch with `halo` layers: the same sums on both sides of every seam, bit for bit.
void sum_halo(Warehouse& warehouse, const Label& label, int patch, int group, int halo);

/// Copies neighbours' values into the `halo` layers around a patch.
void fill_halo(Warehouse& warehouse, const Label& label, int patch, int group, int halo, FieldBuffer buffer);

}  // namespace tamp::runtime
