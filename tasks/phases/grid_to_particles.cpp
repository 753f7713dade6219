#include <algorithm>
#include <array>

#include "components/kinematics/deform.hpp"
#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using components::ParticleMotion;
using runtime::TaskContext;

/// Particles worked on together: their numbers between two kernels stay in the first-level cache.
constexpr std::size_t batch = 32;

/// Particles keep their velocity and take the nodes' changes of it (FLIP). What deforms them is the gradient of the
/// velocity at the middle of the step, over the shape at its middle (eqs 54-58); the old stress turns with them, and
/// what the material answers is added by the next phase.
template <int D>
runtime::TaskDeclaration grid_to_particles(const Method<D>& method)
{
  auto task =
      runtime::task("grid to particles")
          .over_patches_and_groups(method.deformable_materials)
          .sparse()
          .reads(node::inverse_mass.halo(method.halo), node::motion<D>.halo(method.halo), particle::id.previous(),
                 particle::mass.previous(), particle::position<D>.previous(), particle::velocity<D>.previous(),
                 particle::deformation_gradient<D>.previous(), particle::volume.previous(),
                 particle::stress<D>.previous())
          .computes(particle::position<D>, particle::velocity<D>, particle::deformation_gradient<D>, particle::volume,
                    particle::stress<D>, particle::strain_increment<D>, particle::own_stiffness);
  const auto body = [&method](const TaskContext& at, auto data) {
    const auto inverse_mass = data[node::inverse_mass];
    const auto nodes = data[node::motion<D>];
    const auto mass = data[particle::mass.previous()];
    const auto old_position = data[particle::position<D>.previous()];
    const auto position = data[particle::position<D>];
    const auto old_velocity = data[particle::velocity<D>.previous()];
    const auto velocity = data[particle::velocity<D>];
    const auto old_deformation = data[particle::deformation_gradient<D>.previous()];
    const auto deformation = data[particle::deformation_gradient<D>];
    const auto old_volume = data[particle::volume.previous()];
    const auto volume = data[particle::volume];
    const auto old_stress = data[particle::stress<D>.previous()];
    const auto stress = data[particle::stress<D>];
    const auto strain = data[particle::strain_increment<D>];
    const auto own_stiffness = data[particle::own_stiffness];
    const auto block = block_of<D>(at.layout, nodes);
    const components::Interpolation<D>& interpolation = method.interpolation(at.group);
    const bool viscous_rule = method.time_step_rule == StepRule::viscous;
    const double dt = at.step.size;
    std::array<ParticleMotion<D>, batch> motion;
    std::array<Matrix<D>, batch> g;
    for (std::size_t first = 0; first < position.size(); first += batch) {
      const std::size_t size = std::min(batch, position.size() - first);
      interpolation.grid_to_particles(block, old_position.subspan(first, size), nodes.data(),
                                      std::span(motion).first(size));
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t p = first + i;
        g[i] = dt * motion[i].velocity_gradient;
        position[p] = old_position[p] + dt * motion[i].velocity;
        velocity[p] = old_velocity[p] + motion[i].velocity_change;
      }
      const auto inside_out = components::deform<D>({.g = std::span(g).first(size),
                                                     .old_gradient = old_deformation.subspan(first, size),
                                                     .old_volume = old_volume.subspan(first, size),
                                                     .old_stress = old_stress.subspan(first, size),
                                                     .deformation_gradient = deformation.subspan(first, size),
                                                     .volume = volume.subspan(first, size),
                                                     .stress = stress.subspan(first, size),
                                                     .strain_increment = strain.subspan(first, size)});
      if (inside_out) {
        const std::size_t p = first + *inside_out;
        const auto& material = method.materials[static_cast<std::size_t>(at.group)];
        throw SimulationError("a particle is turned inside out", material.name, data[particle::id.previous()][p],
                              {old_position[p].begin(), old_position[p].end()});
      }
      if (viscous_rule) {
        interpolation.own_stiffness(block, old_position.subspan(first, size), mass.subspan(first, size),
                                    inverse_mass.data(), own_stiffness.subspan(first, size));
      } else {
        std::ranges::fill(own_stiffness.subspan(first, size), 0.0);
      }
      if constexpr (data.has(particle::velocity_gradient<D>)) {
        const auto gradient = data[particle::velocity_gradient<D>].subspan(first, size);
        for (std::size_t i = 0; i < size; ++i) gradient[i] = motion[i].velocity_gradient;
      }
    }
  };
  if (method.transfer == Transfer::flip) return std::move(task).body(body);
  return std::move(task).computes(particle::velocity_gradient<D>).body(body);
}

template runtime::TaskDeclaration grid_to_particles(const Method<2>&);
template runtime::TaskDeclaration grid_to_particles(const Method<3>&);

}  // namespace tamp::tasks
