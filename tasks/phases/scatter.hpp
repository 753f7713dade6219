#pragma once

#include <span>

#include "components/shapes/node_sums.hpp"
#include "tasks/labels.hpp"
#include "tasks/method.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

/// The matrices that particles carry to the nodes beside their velocities: velocity gradients, velocity moments, or
/// none.
template <int D, class Data>
std::span<const Matrix<D>> carried_by(const Data& data)
{
  const std::span<const Matrix<D>> gradients = data[particle::velocity_gradient<D>];
  return gradients.empty() ? data[particle::velocity_moment<D>] : gradients;
}

/// Adds to the grid the images behind the walls of what is scattered. Only after that do walls take what does not cross
/// them: the image behind a wall one cell away lies on this one. Rough walls keep what pushes them unless
/// `also_on_rough`.
template <int D, class Value>
void fold_images(const Method<D>& method, const runtime::TaskContext& at, const runtime::GridView<Value>& values,
                 bool also_on_rough)
{
  for_each_wall(method, at, values.box(), [&](const Wall<D>& wall) { wall.image.add_image(values.data()); });
  for_each_wall(method, at, values.box(), [&](const Wall<D>& wall) {
    if (also_on_rough || !wall.traits.keeps_push) wall.image.constrain(values.data());
  });
}

/// The same for all sums of a node. Rough walls keep forces and momenta, but no surface: what lies on them is no
/// surface.
template <int D>
void fold(const Method<D>& method, const runtime::TaskContext& at,
          const runtime::GridView<components::NodeSums<D>>& sums)
{
  const auto hide_surface = [&](int axis) {
    return [&sums, axis](const runtime::Index& i) {
      Vector<D> gradient = sums[i].surface_gradient();
      gradient[axis] = 0;
      sums[i].set_surface_gradient(gradient);
    };
  };
  fold_images(method, at, sums, false);
  for_each_wall(method, at, sums.box(), [&](const Wall<D>& wall) {
    if (!wall.traits.keeps_push) return;
    for_each_wall_node(wall, at.layout.grid(), sums.box(), hide_surface(wall.node.axis));
  });
  for (const components::PlaneWall& wall : method.edge_walls) {
    for_each(nodes_behind(wall, at.layout.grid(), sums.box()), hide_surface(wall.axis));
  }
}

}  // namespace tamp::tasks
