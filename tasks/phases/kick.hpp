#pragma once

#include <array>

#include "components/shapes/node_sums.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// Stops a node along the normals of mirroring walls, which take up what presses on them at rest: without it the
/// Coriolis term would turn a push on the floor into one along it.
inline void hold_at_walls(const std::array<std::array<bool, 2>, 3>& mirrors, const runtime::Grid& grid,
                          const runtime::Index& node, const Vector<3>& frame_acceleration, Vector<3>& velocity,
                          Vector<3>& acceleration)
{
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(mirrors[k][0] && node[k] == 0) && !(mirrors[k][1] && node[k] == grid.n_cells[k])) continue;
    const auto axis = static_cast<Eigen::Index>(k);
    velocity[axis] = 0;
    acceleration[axis] = -frame_acceleration[axis];
  }
}

/// The change of a node's velocity by a kick: the acceleration by its force, and those of the scene.
template <int D>
Vector<D> velocity_change(const Method<D>& method, const runtime::TaskContext& at, const runtime::Index& node,
                          const Vector<D>& velocity, const Vector<D>& by_force, double kick)
{
  Vector<D> acceleration = by_force + method.gravity;
  if constexpr (D == 3) {
    if (method.centrifuge) {
      const Vector<3> x = node_position<3>(at.layout.grid(), node);
      const double time = at.step.time;
      Vector<3> free_velocity = velocity;
      hold_at_walls(method.mirrors, at.layout.grid(), node, method.centrifuge->acceleration(x, Vector<3>::Zero(), time),
                    free_velocity, acceleration);
      return method.centrifuge->velocity_change(x, free_velocity, acceleration, time, kick);
    }
  }
  return kick * acceleration;
}

/// The change of a node's velocity by the kick of this step. Velocities live at the middle of the steps: a kick spans
/// half of the step before and half of this one.
template <int D>
Vector<D> kicked(const Method<D>& method, const runtime::TaskContext& at, const runtime::Index& i,
                 const components::NodeSums<D>& node)
{
  const double mass = node.mass(), kick = 0.5 * (at.step.previous_size + at.step.size);
  if (!(mass > method.least_node_mass)) return Vector<D>::Zero();
  return velocity_change<D>(method, at, i, node.momentum() / mass, node.internal_force() / mass, kick);
}

}  // namespace tamp::tasks
