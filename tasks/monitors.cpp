#include "tasks/monitors.hpp"

#include <algorithm>

namespace tamp::tasks
{

void SampledShare::add(const Share& share, double limit, std::int64_t n_steps, double time, const ParticlePlace& place)
{
  all.part += share.part;
  all.whole += share.whole;
  greatest = std::max(greatest, share.value());
  if (share.value() > limit) above.add(n_steps, time, place);
}

void ContactSample::add(double gap, double impulse, const ParticlePlace& place)
{
  // An edge that cuts through the lattice of particles makes a gap seem up to a quarter of a cell smaller.
  constexpr double early_from = 0.25, within_from = -0.5;
  early.whole += impulse;
  within.whole += impulse;
  if (gap > early_from) {
    early.part += impulse;
    first_early = std::min(first_early, place);
  }
  if (gap < within_from) {
    within.part += impulse;
    first_within = std::min(first_within, place);
  }
}

double missed_substeps(const components::UpdateCounts& updates, std::size_t n_particles)
{
  constexpr std::size_t many = 100;
  if (updates.substeps == 0 || updates.substeps < many * n_particles) return 0;
  return static_cast<double>(updates.limited_substeps) / static_cast<double>(updates.substeps);
}

double out_of_range(const components::UpdateCounts& updates)
{
  const std::size_t squeezed_out = updates.extrapolated - updates.pulled_out;
  return updates.with_range > 0 ? static_cast<double>(squeezed_out) / static_cast<double>(updates.with_range) : 0;
}

}  // namespace tamp::tasks
