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

void BorneShare::add(const Share& sample, double limit, std::int64_t n_steps, double time, const ParticlePlace& place)
{
  greatest.part = std::max(greatest.part, sample.part);
  greatest.whole = std::max(greatest.whole, sample.whole);
  if (Share{sample.part, greatest.whole}.value() > limit) above.add(n_steps, time, place);
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

std::size_t n_out_of_range(const components::UpdateCounts& updates)
{
  return updates.extrapolated - updates.pulled_out - updates.looser;
}

double out_of_range(const components::UpdateCounts& updates)
{
  if (updates.with_range == 0) return 0;
  return static_cast<double>(n_out_of_range(updates)) / static_cast<double>(updates.with_range);
}

}  // namespace tamp::tasks
