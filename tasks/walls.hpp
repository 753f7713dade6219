#pragma once

#include "components/boundary/symmetry.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// Calls `visit(wall)` for every mirroring face of the domain that the patch of `at` touches. `box` is the block
/// of nodes to work on, with its halo layer outside of the wall.
template <int D, class Visit>
void for_each_wall(const Method<D>& method, const runtime::TaskContext& at, const runtime::IndexBox& box, Visit&& visit)
{
  std::array<int, std::size_t{D}> n_nodes;
  for (std::size_t k = 0; k < D; ++k) n_nodes[k] = box.extent(static_cast<int>(k));
  for (std::size_t k = 0; k < D; ++k) {
    const int axis = static_cast<int>(k);
    if (method.mirrors[k][0] && at.patch.cells.lower[k] == 0) {
      visit(components::SymmetryWall<D>(n_nodes, axis, -box.lower[k], -1));
    }
    const int last = at.layout.grid().n_cells[k];
    if (method.mirrors[k][1] && at.patch.cells.upper[k] == last) {
      visit(components::SymmetryWall<D>(n_nodes, axis, last - box.lower[k], +1));
    }
  }
}

/// The nodes that this patch counts in sums over all: its own, and those beyond an open face that particles still
/// reach.
template <int D>
runtime::IndexBox counted_nodes(const Method<D>& method, const runtime::TaskContext& at)
{
  runtime::IndexBox nodes = at.layout.owned_nodes(at.patch);
  for (std::size_t k = 0; k < D; ++k) {
    if (!method.mirrors[k][0] && at.patch.cells.lower[k] == 0) --nodes.lower[k];
    if (!method.mirrors[k][1] && at.patch.cells.upper[k] == at.layout.grid().n_cells[k]) ++nodes.upper[k];
  }
  return nodes;
}

}  // namespace tamp::tasks
