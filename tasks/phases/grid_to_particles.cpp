#include <algorithm>
#include <array>

#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/monitors.hpp"
#include "tasks/phases/deform.hpp"
#include "tasks/phases/gravity_work.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

using components::ParticleMotion;
using components::Passes;
using runtime::TaskContext;

namespace
{

template <int D>
using Motions = std::span<const ParticleMotion<D>>;

/// Updates the velocities of particles by the transfer. `restored` is what passes from the start of the step restore of
/// them; without such passes 0.
template <int D>
void transfer_velocities(const Method<D>& method, std::span<const Vector<D>> before, Motions<D> motion,
                         std::span<const Vector<D>> restored, std::span<Vector<D>> after)
{
  method.with_transfer([&](const auto& transfer) {
    for (std::size_t i = 0; i < motion.size(); ++i) {
      after[i] = transfer.velocity(before[i], motion[i], restored[i]);
    }
  });
}

/// Particles from `first` on go where the grid takes them.
template <int D, class Data>
void move(const Method<D>& method, double dt, const Data& data, std::size_t first, Motions<D> motion,
          std::span<const Vector<D>> restored)
{
  const auto old_position = data[particle::position<D>.previous()];
  const auto position = data[particle::position<D>];
  const auto gradient = data[particle::velocity_gradient<D>];
  for (std::size_t i = 0; i < motion.size(); ++i) {
    position[first + i] = old_position[first + i] + dt * motion[i].velocity;
    if (!gradient.empty()) gradient[first + i] = motion[i].velocity_gradient;
  }
  transfer_velocities<D>(method, data[particle::velocity<D>.previous()].subspan(first, motion.size()), motion, restored,
                         data[particle::velocity<D>].subspan(first, motion.size()));
}

/// Adds the momentum that a transfer that filters velocities gives to particles beside the nodes' part.
template <int D, class Data>
void add_filtered_momentum(const Data& data, std::size_t first, Motions<D> motion)
{
  const auto mass = data[particle::mass.previous()];
  const auto before = data[particle::velocity<D>.previous()];
  const auto after = data[particle::velocity<D>];
  auto& sum = data[grid_totals].impulse;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const std::size_t p = first + i;
    const Vector<D> filtered = mass[p] * (after[p] - before[p] - motion[i].velocity_change);
    for (std::size_t k = 0; k < std::size_t{D}; ++k) sum[k] += filtered[static_cast<int>(k)];
  }
}

/// Adds the motion of particles, and what of it the nodes do not see.
template <int D, class Data>
void add_null_space(const Data& data, std::size_t first, Motions<D> motion)
{
  const auto mass = data[particle::mass.previous()];
  const auto velocity = data[particle::velocity<D>];
  Share& sum = data[null_space_motion];
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const std::size_t p = first + i;
    sum.whole += 0.5 * mass[p] * velocity[p].squaredNorm();
    sum.part += 0.5 * mass[p] * (velocity[p] - motion[i].velocity).squaredNorm();
  }
}

/// Kinetic energy that `n` particles from `first` on have gained [J].
template <int D, class Data>
double gained(const Data& data, std::size_t first, std::size_t n)
{
  const auto mass = data[particle::mass.previous()];
  const auto old_velocity = data[particle::velocity<D>.previous()];
  const auto velocity = data[particle::velocity<D>];
  double energy = 0;
  for (std::size_t p = first; p < first + n; ++p) {
    energy += 0.5 * mass[p] * (velocity[p] - old_velocity[p]).dot(velocity[p] + old_velocity[p]);
  }
  return energy;
}

/// Counts what gravity does to `n` particles from `first` on.
template <int D, class Data>
void count_gravity(const Method<D>& method, double dt, const Data& data, std::size_t first, std::size_t n)
{
  if (method.is_weightless()) return;
  const auto mass = data[particle::mass.previous()];
  const auto before = data[particle::position<D>.previous()];
  const auto after = data[particle::position<D>];
  const auto velocity = data[particle::velocity<D>];
  GridTotals totals;
  for (std::size_t p = first; p < first + n; ++p) {
    add_gravity_work<D>(method, dt, mass[p], before[p], after[p], velocity[p], totals);
  }
  runtime::combine(data[grid_totals], totals);
}

}  // namespace

template <int D>
runtime::TaskList grid_to_particles(const Method<D>& method)
{
  if (method.deformable_materials.empty()) return {};
  const bool deforms = method.stress_timing == StressTiming::usl;
  const bool restores = method.passes == Passes::from_start && method.n_passes > 0;
  const bool filters = method.with_transfer([](const auto& transfer) { return transfer.filters; });
  auto task = runtime::task("grid to particles")
                  .over_patches_and_groups(method.deformable_materials)
                  .sparse()
                  .reads(node::motion<D>.halo(method.halo), node::velocity_terms<D>.halo(method.halo).when(restores),
                         node::inverse_mass.halo(method.halo).when(deforms), particle::mass.previous(),
                         particle::position<D>.previous(), particle::velocity<D>.previous(),
                         particle::deformation_gradient<D>.previous())
                  .computes(particle::position<D>, particle::velocity<D>,
                            particle::velocity_gradient<D>.when(method.brings_gradients()),
                            particle::velocity_moment<D>.when(method.brings_moments()))
                  .reduces(grid_totals, null_space_motion);
  return {deforming(method, std::move(task), deforms).body([=, &method](const TaskContext& at, auto data) {
    const auto nodes = data[node::motion<D>];
    const auto terms = data[node::velocity_terms<D>];
    const auto moments = data[particle::velocity_moment<D>];
    const double* const inverse_mass = data[node::inverse_mass].data();
    const auto block = block_of<D>(at.layout, nodes);
    const auto places = places_at_start<D>(data);
    const components::Interpolation<D>& interpolation = method.interpolation(at.group);
    clear_cells(data);
    std::array<ParticleMotion<D>, motion_batch> buffer;
    std::array<Vector<D>, motion_batch> restored;
    restored.fill(Vector<D>::Zero());
    const bool is_sampled = method.scene.limits.samples_after(at.step.index + 1);
    for (std::size_t first = 0; first < places.size(); first += motion_batch) {
      const std::size_t size = std::min(motion_batch, places.size() - first);
      const auto batch = places.subspan(first, size);
      const auto motion = std::span(buffer).first(size);
      components::ParticleTargets<D> to{.motion = motion};
      if (!moments.empty()) to.velocity_moments = moments.subspan(first, size);
      if (deforms) to.own_stiffness = own_stiffness_of<D>(method, data, inverse_mass, first, size);
      interpolation.grid_to_particles(block, batch, nodes.data(), to);
      if (restores) interpolation.interpolate(block, batch, terms.data(), restored);
      move<D>(method, at.step.size, data, first, motion, restored);
      data[grid_totals].gained_by_particles += gained<D>(data, first, size);
      count_gravity<D>(method, at.step.size, data, first, size);
      if (filters) add_filtered_momentum<D>(data, first, motion);
      if (is_sampled) add_null_space<D>(data, first, motion);
      if (deforms) take_gradients<D>(method, at, data, block, nodes.data(), inverse_mass, first, motion);
    }
  })};
}

template runtime::TaskList grid_to_particles(const Method<2>&);
template runtime::TaskList grid_to_particles(const Method<3>&);

}  // namespace tamp::tasks
