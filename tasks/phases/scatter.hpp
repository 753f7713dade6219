#pragma once

#include <span>

#include "components/shapes/node_sums.hpp"
#include "tasks/labels.hpp"
#include "tasks/method.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

/// What particles carry to the nodes beside their velocities, one of the two or nothing.
template <int D, class Data>
std::span<const Matrix<D>> carried_by(const Data& data)
{
  const std::span<const Matrix<D>> gradients = data[particle::velocity_gradient<D>];
  return gradients.empty() ? data[particle::velocity_moment<D>] : gradients;
}

/// Adds to the grid the image of what is scattered behind a wall.
template <int D>
void fold(const Wall<D>& wall, const runtime::TaskContext& at, const runtime::GridView<components::NodeSums<D>>& sums)
{
  if (!wall.keeps_normal_push()) return wall.image.fold(sums.data());
  wall.image.add_image(sums.data());
  for_each_wall_node(wall, at.layout.grid(), sums.box(), [&](const runtime::Index& i) {
    Vector<D> gradient = sums[i].surface_gradient();
    gradient[wall.axis] = 0;
    sums[i].set_surface_gradient(gradient);
  });
}

}  // namespace tamp::tasks
