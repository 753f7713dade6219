#pragma once

#include <algorithm>

#include "components/boundary/faces.hpp"
#include "components/contact/wall_gaps.hpp"
#include "components/shapes/node_sums.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// A wall of the domain: where it lies, and what it does to what touches it.
template <int D>
struct Wall {
  const Face& face;
  components::FaceTraits traits;
  components::WallNode node;
  components::SymmetryWall<D> image;
};

/// Calls `visit(wall)` for every wall of the domain that the patch of `at` touches. `box` is the block of nodes to work
/// on, with its halo layer outside of the wall.
template <int D, class Visit>
void for_each_wall(const Method<D>& method, const runtime::TaskContext& at, const runtime::IndexBox& box, Visit&& visit)
{
  std::array<int, std::size_t{D}> n_nodes;
  for (std::size_t k = 0; k < D; ++k) n_nodes[k] = box.extent(static_cast<int>(k));
  for (std::size_t k = 0; k < D; ++k) {
    const std::array<int, 2> at_edge{0, at.layout.grid().n_cells[k]};
    const std::array<int, 2> of_patch{at.patch.cells.lower[k], at.patch.cells.upper[k]};
    for (std::size_t side = 0; side < 2; ++side) {
      if (!method.mirrors[k][side] || of_patch[side] != at_edge[side]) continue;
      const int axis = static_cast<int>(k), outside = side == 0 ? -1 : 1;
      const Face& face = method.scene.faces[k][side];
      visit(Wall<D>{face,
                    components::traits_of(face),
                    {axis, outside, method.cell_size, at.step.size},
                    {n_nodes, axis, at_edge[side] - box.lower[k], outside}});
    }
  }
}

/// Shows the bound on the step the masses of the whole beside mirrors, where a particle is as far from any edge as it
/// is from the body's own. Walls that may be left stay edges.
template <int D>
void complete_inverse_masses(const Method<D>& method, const runtime::TaskContext& at,
                             const runtime::GridView<double>& inverse_mass)
{
  for_each_wall(method, at, inverse_mass.box(), [&](const Wall<D>& wall) {
    if (wall.traits.is_mirror) wall.image.complete_inverse_masses(inverse_mass.data());
  });
}

/// Calls `visit(node)` for the nodes of `box` on the wall.
template <int D, class Visit>
void for_each_wall_node(const Wall<D>& wall, const runtime::Grid& grid, runtime::IndexBox box, Visit&& visit)
{
  const auto k = static_cast<std::size_t>(wall.node.axis);
  box.lower[k] = wall.node.outside < 0 ? 0 : grid.n_cells[k];
  box.upper[k] = box.lower[k] + 1;
  for_each(box, visit);
}

/// The nodes of `box` on a wall that is touched at edges, and behind it.
inline runtime::IndexBox nodes_behind(const components::PlaneWall& wall, const runtime::Grid& grid,
                                      runtime::IndexBox box)
{
  const auto k = static_cast<std::size_t>(wall.axis);
  if (wall.outside < 0) {
    box.upper[k] = std::min(box.upper[k], 1);
  } else {
    box.lower[k] = std::max(box.lower[k], grid.n_cells[k]);
  }
  return box;
}

/// The nodes that this patch counts in sums over all: its own, and those beyond an open face that particles still
/// reach. A periodic axis has no faces.
template <int D>
runtime::IndexBox counted_nodes(const Method<D>& method, const runtime::TaskContext& at)
{
  runtime::IndexBox nodes = at.layout.owned_nodes(at.patch);
  for (std::size_t k = 0; k < D; ++k) {
    if (at.layout.grid().periodic[k]) continue;
    if (!method.mirrors[k][0] && at.patch.cells.lower[k] == 0) --nodes.lower[k];
    if (!method.mirrors[k][1] && at.patch.cells.upper[k] == at.layout.grid().n_cells[k]) ++nodes.upper[k];
  }
  return nodes;
}

/// The mass by which the particles of a node take momentum along an axis. Nodes inside a mirror also hold the mass of
/// the image, whose normal momentum is opposite: it is taken off again.
template <int D>
double own_mass(const Method<D>& method, const runtime::TaskContext& at,
                const runtime::GridView<const components::NodeSums<D>>& sums, const runtime::Index& i, std::size_t axis)
{
  double mass = sums[i].mass();
  for (const int side : {0, 1}) {
    const int wall = side == 0 ? 0 : at.layout.grid().n_cells[axis];
    const int outside = side == 0 ? -1 : 1;
    if (!method.mirrors[axis][static_cast<std::size_t>(side)] || i[axis] != wall - outside) continue;
    runtime::Index ghost = i;
    ghost[axis] = wall + outside;
    mass -= 2 * sums[ghost].mass();
  }
  return mass;
}

}  // namespace tamp::tasks
