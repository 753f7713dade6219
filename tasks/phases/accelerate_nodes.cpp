#include <array>

#include "components/loads/local_damping.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::NodeSums;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

/// What a node on mirroring walls is left with when they take up what presses on them at rest: without it the Coriolis
/// term would turn a push on the floor into one along it.
void hold_at_walls(const std::array<std::array<bool, 2>, 3>& mirrors, const runtime::Grid& grid, const Index& node,
                   const Vector<3>& frame_acceleration, Vector<3>& velocity, Vector<3>& acceleration)
{
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(mirrors[k][0] && node[k] == 0) && !(mirrors[k][1] && node[k] == grid.n_cells[k])) continue;
    const auto axis = static_cast<Eigen::Index>(k);
    velocity[axis] = 0;
    acceleration[axis] = -frame_acceleration[axis];
  }
}

/// What a kick adds to the velocity of a node: the acceleration by its force, and those of the scene.
template <int D>
Vector<D> velocity_change(const Method<D>& method, const TaskContext& at, const Index& node, const Vector<D>& velocity,
                          const Vector<D>& by_force, double kick)
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

}  // namespace

/// Leapfrog: velocities live at the middle of the steps, so the kick spans half of the step before and half of this
/// one. With v_n = v_{n-1/2} + a dt/2 the positions then move by v_n dt + a dt^2/2, which is eq. 42 of
/// PAR-10021867-092020-6. At the very start velocity and position are of one time, and the kick is half a step.
template <int D>
runtime::TaskDeclaration accelerate_nodes(const Method<D>& method)
{
  return runtime::task("accelerate nodes")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(node::sums<D>.halo(method.halo))
      .computes(node::motion<D>.halo(method.halo), node::inverse_mass.halo(method.halo))
      .reduces(grid_totals)
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motion = data[node::motion<D>];
        const auto inverse_mass = data[node::inverse_mass];
        double& taken = data[grid_totals].taken_by_damping;
        const runtime::IndexBox counted = counted_nodes(method, at);
        const double kick = 0.5 * (at.step.previous_size + at.step.size);
        for_each(sums.box(), [&](const Index& i) {
          const NodeSums<D>& node = sums[i];
          const double mass = node.mass();
          inverse_mass[i] = mass > method.least_node_mass ? 1 / mass : 0;
          if (!(mass > 0)) {
            motion[i] = {};
            return;
          }
          const Vector<D> velocity = node.momentum() / mass;
          const Vector<D> by_force = node.internal_force() / mass;
          Vector<D> change = Vector<D>::Zero();
          if (mass > method.least_node_mass) {
            change = velocity_change(method, at, i, velocity, by_force, kick);
          }
          if (method.damping > 0) {
            const Vector<D> undamped = change;
            change = components::damped_change<D>(velocity, undamped, method.damping);
            // Nodes on a seam are worked on by every patch around it, and counted by one.
            if (counted.contains(i)) taken += 0.5 * mass * (undamped - change).dot(2 * velocity + change);
          }
          motion[i].set(velocity + change, change);
        });
      });
}

template runtime::TaskDeclaration accelerate_nodes(const Method<2>&);
template runtime::TaskDeclaration accelerate_nodes(const Method<3>&);

}  // namespace tamp::tasks
