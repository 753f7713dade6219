#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "components/contact/parted_particles.hpp"
#include "tasks/labels.hpp"
#include "tasks/method.hpp"
#include "tasks/phases/walls.hpp"

/// Operations on the planes at nodes that separate the particles of two materials.
namespace tamp::tasks
{

struct MaterialPair {
  std::size_t first;
  std::size_t second;
};

/// The two materials at a node, where no third one is.
template <int D>
std::optional<MaterialPair> pair_alone_at(
    const Method<D>& method, const runtime::PerGroup<runtime::GridView<const components::NodeSums<D>>>& sums,
    const runtime::Index& i)
{
  std::array<std::size_t, 2> here;
  std::size_t n_here = 0;
  for (std::size_t g = 0; g < sums.size(); ++g) {
    if (!(sums[g][i].mass() > method.least_node_mass)) continue;
    if (n_here == here.size()) return {};
    here[n_here++] = g;
  }
  if (n_here < here.size()) return {};
  return MaterialPair{here[0], here[1]};
}

/// The two materials that see a plane at a node.
template <class Planes>
std::optional<MaterialPair> parted_at(const Planes& planes, const runtime::Index& i)
{
  MaterialPair pair{planes.size(), planes.size()};
  for (std::size_t g = 0; g < planes.size(); ++g) {
    if (planes[g][i].side < 0) pair.first = g;
    if (planes[g][i].side > 0) pair.second = g;
  }
  if (pair.first == planes.size()) return {};
  return pair;
}

/// Nodes beyond a mirror see the plane of their mirror node.
template <int D>
void mirror_planes(const Method<D>& method, const runtime::TaskContext& at,
                   const runtime::PerGroup<runtime::GridView<components::ContactPlane<D>>>& planes)
{
  for (const auto& plane : planes) {
    for_each_wall(method, at, plane.box(), [&](const Wall<D>& wall) { wall.image.constrain(plane.data()); });
    for_each_wall(method, at, plane.box(), [&](const Wall<D>& wall) { wall.image.mirror(plane.data()); });
  }
}

/// Makes planes known beyond mirrors, and to the cells that reach them.
template <int D>
void spread_planes(const Method<D>& method, const runtime::TaskContext& at,
                   const runtime::PerGroup<runtime::GridView<components::ContactPlane<D>>>& planes)
{
  mirror_planes(method, at, planes);
  for (const auto& plane : planes) components::mark_near_cells(block_of<D>(at.layout, plane), plane.data());
}

/// A pass over the particles that makes the `node::edge_sums` of nodes with a plane.
template <int D>
runtime::TaskDeclaration find_edges(const Method<D>& method);

/// How far a material reaches along its normal beyond a node [m].
template <int D>
double edge_at(const Method<D>& method, std::size_t material, const components::EdgeSums<D>& sums)
{
  return method.cell_size * sums.edge(1.0 / method.scene.particles_per_axis_of(static_cast<int>(material)));
}

}  // namespace tamp::tasks
