#include <algorithm>
#include <array>

#include "components/kinematics/deform.hpp"
#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using components::ParticleMotion;
using runtime::TaskContext;

namespace
{

/// Particles worked on together: their numbers between two kernels stay in the first-level cache.
constexpr std::size_t batch = 32;

template <int D>
using Motions = std::span<const ParticleMotion<D>>;

/// Particles from `first` on go where the grid takes them. They keep their velocity and take the nodes' changes of it
/// (FLIP).
template <int D, class Data>
void move(double dt, const Data& data, std::size_t first, Motions<D> motion)
{
  const auto old_position = data[particle::position<D>.previous()];
  const auto position = data[particle::position<D>];
  const auto old_velocity = data[particle::velocity<D>.previous()];
  const auto velocity = data[particle::velocity<D>];
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const std::size_t p = first + i;
    position[p] = old_position[p] + dt * motion[i].velocity;
    velocity[p] = old_velocity[p] + motion[i].velocity_change;
    if constexpr (data.has(particle::velocity_gradient<D>)) {
      data[particle::velocity_gradient<D>][p] = motion[i].velocity_gradient;
    }
  }
}

/// What deforms particles is the gradient of the velocity at the middle of the step, over the shape at its middle (eqs
/// 54-58); the old stress turns with them, and what the material answers is added by the next phase.
template <int D, class Data>
void deform(const Method<D>& method, const TaskContext& at, const Data& data, std::size_t first, Motions<D> motion)
{
  std::array<Matrix<D>, batch> g;
  for (std::size_t i = 0; i < motion.size(); ++i) g[i] = at.step.size * motion[i].velocity_gradient;
  const auto of_batch = [&](const auto& field) { return field.subspan(first, motion.size()); };
  const auto inside_out =
      components::deform<D>({.g = std::span(g).first(motion.size()),
                             .old_gradient = of_batch(data[particle::deformation_gradient<D>.previous()]),
                             .old_volume = of_batch(data[particle::volume.previous()]),
                             .old_stress = of_batch(data[particle::stress<D>.previous()]),
                             .deformation_gradient = of_batch(data[particle::deformation_gradient<D>]),
                             .volume = of_batch(data[particle::volume]),
                             .stress = of_batch(data[particle::stress<D>]),
                             .strain_increment = of_batch(data[particle::strain_increment<D>])});
  if (!inside_out) return;
  const std::size_t p = first + *inside_out;
  const Vector<D>& x = data[particle::position<D>.previous()][p];
  throw SimulationError("a particle is turned inside out", method.materials[static_cast<std::size_t>(at.group)].name,
                        data[particle::id.previous()][p], {x.begin(), x.end()});
}

}  // namespace

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
    const auto own_stiffness = data[particle::own_stiffness];
    const auto block = block_of<D>(at.layout, nodes);
    const auto places = places_at_start<D>(data);
    const components::Interpolation<D>& interpolation = method.interpolation(at.group);
    std::array<ParticleMotion<D>, batch> buffer;
    for (std::size_t first = 0; first < mass.size(); first += batch) {
      const std::size_t size = std::min(batch, mass.size() - first);
      const auto motion = std::span(buffer).first(size);
      interpolation.grid_to_particles(block, places.subspan(first, size), nodes.data(), motion);
      move<D>(at.step.size, data, first, motion);
      deform<D>(method, at, data, first, motion);
      if (method.time_step_rule == StepRule::viscous) {
        interpolation.own_stiffness(block, places.subspan(first, size), mass.subspan(first, size), inverse_mass.data(),
                                    own_stiffness.subspan(first, size));
      } else {
        std::ranges::fill(own_stiffness.subspan(first, size), 0.0);
      }
    }
  };
  if (method.transfer == Transfer::flip) return std::move(task).body(body);
  return std::move(task).computes(particle::velocity_gradient<D>).body(body);
}

template runtime::TaskDeclaration grid_to_particles(const Method<2>&);
template runtime::TaskDeclaration grid_to_particles(const Method<3>&);

}  // namespace tamp::tasks
