#include "tasks/labels.hpp"
#include "tasks/phases/kick.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::NodeSums;
using runtime::Index;
using runtime::TaskContext;

/// Leapfrog: velocities live at the middle of the steps, so the kick spans half of the step before and half of this
/// one. With v_n = v_{n-1/2} + a dt/2 the positions then move by v_n dt + a dt^2/2, which is eq. 42 of
/// PAR-10021867-092020-6. At the very start velocity and position are of one time, and the kick is half a step.
template <int D>
runtime::TaskList accelerate_nodes(const Method<D>& method, bool computes_inverse_mass)
{
  if (method.deformable_materials.empty()) return {};
  return {
      runtime::task("accelerate nodes")
          .over_patches_and_groups(method.deformable_materials)
          .sparse()
          .reads(node::sums<D>.halo(method.halo))
          .computes(node::motion<D>.halo(method.halo), node::inverse_mass.halo(method.halo).when(computes_inverse_mass))
          .body([&method, computes_inverse_mass](const TaskContext& at, auto data) {
            const auto sums = data[node::sums<D>];
            const auto motion = data[node::motion<D>];
            const auto inverse_mass = data[node::inverse_mass];
            for_each(sums.box(), [&](const Index& i) {
              const NodeSums<D>& node = sums[i];
              const double mass = node.mass();
              if (computes_inverse_mass) inverse_mass[i] = mass > method.least_node_mass ? 1 / mass : 0;
              if (!(mass > 0)) {
                motion[i] = {};
                return;
              }
              const Vector<D> velocity = node.momentum() / mass;
              const Vector<D> change = kicked(method, at, i, node);
              motion[i].set(velocity + change, change);
            });
            if (computes_inverse_mass) complete_inverse_masses(method, at, inverse_mass);
          })};
}

template runtime::TaskList accelerate_nodes(const Method<2>&, bool);
template runtime::TaskList accelerate_nodes(const Method<3>&, bool);

}  // namespace tamp::tasks
