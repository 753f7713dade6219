#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "tasks/labels.hpp"
#include "tasks/phases/deform.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/scatter.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::NodeSums;
using components::ParticleMotion;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

/// Particles bring the newest velocities that they have to the nodes, with the weights of the step. What they bring of
/// forces besides, nobody asks for.
template <int D>
runtime::TaskDeclaration carry(const Method<D>& method)
{
  using runtime::StepEnd;
  const StepEnd end = method.stress_timing == StressTiming::usf ? StepEnd::start : StepEnd::end;
  return runtime::task("carry velocities")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(particle::position<D>.previous(), particle::deformation_gradient<D>.previous(), particle::mass.previous(),
             particle::volume.previous(), particle::stress<D>.previous(), particle::viscous_pressure.previous(),
             particle::velocity<D>.at(end), particle::velocity_gradient<D>.at(end).when(method.brings_gradients()),
             particle::velocity_moment<D>.at(end).when(method.brings_moments()))
      .accumulates(node::carried_sums<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::carried_sums<D>];
        const components::ParticleSources<D> sources{.places = places_at_start<D>(data),
                                                     .velocity = data[particle::velocity<D>],
                                                     .mass = data[particle::mass.previous()],
                                                     .volume = data[particle::volume.previous()],
                                                     .stress = data[particle::stress<D>.previous()],
                                                     .viscous_pressure = data[particle::viscous_pressure.previous()],
                                                     .carried_gradient = method.carried_gradient,
                                                     .carried = carried_by<D>(data)};
        method.interpolation(at.group).particles_to_grid(block_of<D>(at.layout, sums), sources, false, sums.data());
        fold(method, at, sums);
      });
}

template <int D>
void hold_carried(const Wall<D>& wall, const TaskContext& at, const GridView<NodeMotion<D>>& motion)
{
  if (wall.traits.is_mirror) wall.image.constrain(motion.data());
  components::with_wall(wall.face, [&](const auto& kind) {
    for_each_wall_node(wall, at.layout.grid(), motion.box(), [&](const Index& i) {
      motion[i].set(kind.template carried_velocity<D>(motion[i].velocity(), wall.node), Vector<D>::Zero());
    });
  });
}

/// Turns the sums into velocities on the nodes.
template <int D>
runtime::TaskDeclaration take_carried(const Method<D>& method)
{
  return runtime::task("take carried velocities")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(node::carried_sums<D>.halo(method.halo))
      .computes(node::carried_motion<D>.halo(method.halo), node::inverse_mass.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::carried_sums<D>];
        const auto motion = data[node::carried_motion<D>];
        const auto inverse_mass = data[node::inverse_mass];
        for_each(sums.box(), [&](const Index& i) {
          motion[i] = {};
          const double mass = sums[i].mass();
          inverse_mass[i] = mass > method.least_node_mass ? 1 / mass : 0;
          if (mass > 0) motion[i].set(sums[i].momentum() / mass, Vector<D>::Zero());
        });
        complete_inverse_masses(method, at, inverse_mass);
        for_each_wall(method, at, motion.box(), [&](const Wall<D>& wall) { hold_carried(wall, at, motion); });
        for_each_wall(method, at, motion.box(), [&](const Wall<D>& wall) { wall.image.mirror(motion.data()); });
      });
}

/// Particles deform by them.
template <int D>
runtime::TaskDeclaration deform_by_carried(const Method<D>& method)
{
  auto task = runtime::task("deform particles")
                  .over_patches_and_groups(method.deformable_materials)
                  .sparse()
                  .reads(node::carried_motion<D>.halo(method.halo), node::inverse_mass.halo(method.halo),
                         particle::mass.previous(), particle::position<D>.previous(),
                         particle::deformation_gradient<D>.previous());
  return deforming(method, std::move(task), true).body([&method](const TaskContext& at, auto data) {
    const auto nodes = data[node::carried_motion<D>];
    const auto block = block_of<D>(at.layout, nodes);
    const auto places = places_at_start<D>(data);
    const double* const inverse_mass = data[node::inverse_mass].data();
    clear_cells(data);
    std::array<ParticleMotion<D>, motion_batch> buffer;
    for (std::size_t first = 0; first < places.size(); first += motion_batch) {
      const auto batch = places.subspan(first, std::min(motion_batch, places.size() - first));
      const auto motion = std::span(buffer).first(batch.size());
      method.interpolation(at.group).grid_to_particles(
          block, batch, nodes.data(),
          {.motion = motion, .own_stiffness = own_stiffness_of<D>(method, data, inverse_mass, first, batch.size())});
      take_gradients<D>(method, at, data, block, nodes.data(), inverse_mass, first, motion);
    }
  });
}

}  // namespace

/// Each material by the velocities of its own particles alone: contact has worked on these, in this step or in the step
/// before, and is not asked again.
template <int D>
runtime::TaskList deform_by_carried_velocities(const Method<D>& method)
{
  if (method.stress_timing == StressTiming::usl || method.deformable_materials.empty()) return {};
  return {carry(method), take_carried(method), deform_by_carried(method)};
}

template runtime::TaskList deform_by_carried_velocities(const Method<2>&);
template runtime::TaskList deform_by_carried_velocities(const Method<3>&);

}  // namespace tamp::tasks
