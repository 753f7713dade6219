#include "tasks/labels.hpp"
#include "tasks/phases.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::NodeSums;
using runtime::GridView;
using runtime::TaskContext;

namespace
{

/// Nodes of a rigid body move as it would without contact.
template <class Interpolator, int D = Interpolator::dimension>
void move_freely(const TaskContext& at, const RigidBody& body, const GridView<const NodeSums<D>>& sums,
                 const GridView<NodeMotion<D>>& motion)
{
  const components::RigidMotion free = components::motion_of(body.properties, body.free);
  for_each(motion.box(), [&](const runtime::Index& i) {
    motion[i] = {};
    if (!(sums[i].mass() > 0)) return;
    motion[i].set(free.at(in_space<D>(place_of<D>(at.layout.grid(), i))).template head<D>(), Vector<D>::Zero());
  });
}

}  // namespace

/// Leapfrog: velocities live at the middle of the steps, so the kick spans half of the step before and half of this
/// one. With v_n = v_{n-1/2} + a dt/2 the positions then move by v_n dt + a dt^2/2, which is eq. 42 of
/// PAR-10021867-092020-6. At the very start velocity and position are of one time, and the kick is half a step.
template <class Interpolator>
runtime::TaskDeclaration accelerate_nodes(const Method<Interpolator>& method)
{
  constexpr int D = Interpolator::dimension;
  return runtime::task("accelerate nodes")
      .over_patches_and_groups()
      .reads(node::sums<D>.halo(1))
      .computes(node::motion<D>.halo(1))
      .body([&method](const TaskContext& at, GridView<const NodeSums<D>> sums, GridView<NodeMotion<D>> motion) {
        if (const RigidBody* body = method.rigid_body(at.group)) {
          move_freely<Interpolator>(at, *body, sums, motion);
          return;
        }
        const double kick = 0.5 * (at.step.previous_size + at.step.size);
        const std::int64_t n_nodes = sums.box().size();
        for (std::int64_t i = 0; i < n_nodes; ++i) {
          const NodeSums<D>& node = sums.data()[i];
          const double mass = node.mass();
          if (mass > 0) {
            const bool accelerated = mass > method.least_node_mass;
            const Vector<D> change =
                accelerated ? Vector<D>(kick * (node.internal_force() / mass + method.gravity)) : Vector<D>::Zero();
            motion.data()[i].set(node.momentum() / mass + change, change);
          } else {
            motion.data()[i] = {};
          }
        }
      });
}

template runtime::TaskDeclaration accelerate_nodes(const Method<components::Gimp<2>>&);
template runtime::TaskDeclaration accelerate_nodes(const Method<components::Gimp<3>>&);

}  // namespace tamp::tasks
