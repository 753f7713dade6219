#include <algorithm>
#include <array>

#include "components/kinematics/strain_increment.hpp"
#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::ParticleMotion;
using components::StrainIncrement;
using runtime::GridView;
using runtime::TaskContext;

/// Particles worked on together: their numbers between two kernels stay in the first-level cache.
constexpr std::size_t batch = 32;

/// Particles keep their velocity and take the nodes' changes of it (FLIP). What deforms them is the gradient of the
/// velocity at the middle of the step, over the shape at its middle (eqs 54-58); the old stress turns with them, and
/// what the material answers is added by the next phase. `velocity_gradient` is there where the transfer is affine.
template <class Interpolator>
runtime::TaskDeclaration grid_to_particles(const Method<Interpolator>& method)
{
  constexpr int D = Interpolator::dimension;
  auto task =
      runtime::task("grid to particles")
          .over_patches_and_groups(method.deformable_groups)
          .sparse()
          .reads(node::inverse_mass.halo(1), node::motion<D>.halo(1), particle::id.previous(),
                 particle::mass.previous(), particle::position<D>.previous(), particle::velocity<D>.previous(),
                 particle::deformation_gradient<D>.previous(), particle::volume.previous(),
                 particle::stress<D>.previous())
          .computes(particle::position<D>, particle::velocity<D>, particle::deformation_gradient<D>, particle::volume,
                    particle::stress<D>, particle::strain_increment<D>, particle::own_stiffness);
  const auto body = [&method](const TaskContext& at, GridView<const double> inverse_mass,
                              GridView<const NodeMotion<D>> nodes, std::span<const std::int64_t> id,
                              std::span<const double> mass, std::span<const Vector<D>> old_position,
                              std::span<const Vector<D>> old_velocity, std::span<const Matrix<D>> old_deformation,
                              std::span<const double> old_volume, std::span<const SymmetricTensor<D>> old_stress,
                              std::span<Vector<D>> position, std::span<Vector<D>> velocity,
                              std::span<Matrix<D>> deformation, std::span<double> volume,
                              std::span<SymmetricTensor<D>> stress, std::span<SymmetricTensor<D>> strain,
                              std::span<double> own_stiffness, auto... velocity_gradient) {
    const auto block = block_of<D>(at.layout, nodes);
    const auto& interpolator = method.interpolator(at.group);
    const bool viscous_rule = method.time_step_rule == StepRule::viscous;
    const double dt = at.step.size;
    std::array<ParticleMotion<D>, batch> motion;
    std::array<Matrix<D>, batch> g;
    std::array<StrainIncrement<D>, batch> steps;
    for (std::size_t first = 0; first < position.size(); first += batch) {
      const std::size_t size = std::min(batch, position.size() - first);
      for (std::size_t i = 0; i < size; ++i) {
        motion[i] = components::grid_to_particle(interpolator, block, old_position[first + i], nodes.data());
        g[i] = dt * motion[i].velocity_gradient;
      }
      components::strain_increments<D>(old_deformation.subspan(first, size), std::span(g).first(size),
                                       std::span(steps).first(size));
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t p = first + i;
        const StrainIncrement<D>& step = steps[i];
        if (!step.admissible()) {
          const auto& material = method.materials[static_cast<std::size_t>(at.group)];
          throw SimulationError("a particle is turned inside out", material.name, id[p],
                                {old_position[p].begin(), old_position[p].end()});
        }
        position[p] = old_position[p] + dt * motion[i].velocity;
        velocity[p] = old_velocity[p] + motion[i].velocity_change;
        ((velocity_gradient[p] = motion[i].velocity_gradient), ...);
        deformation[p] = step.deformation_gradient;
        volume[p] = old_volume[p] * step.volume_ratio;
        stress[p] = rotated<D>(old_stress[p], step.rotation_increment);
        strain[p] = step.strain_increment;
        own_stiffness[p] =
            viscous_rule ? components::own_stiffness(interpolator, block, old_position[p], mass[p], inverse_mass.data())
                         : 0;
      }
    }
  };
  if (method.transfer == Transfer::flip) return std::move(task).body(body);
  return std::move(task).computes(particle::velocity_gradient<D>).body(body);
}

template runtime::TaskDeclaration grid_to_particles(const Method<components::Gimp<2>>&);
template runtime::TaskDeclaration grid_to_particles(const Method<components::Gimp<3>>&);

}  // namespace tamp::tasks
