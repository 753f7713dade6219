#include "components/kinematics/deform.hpp"

#include <algorithm>

#include "components/kinematics/strain_increment.hpp"
#include "components/lanes.hpp"
#include "components/tensor_lanes.hpp"

namespace tamp::components
{

namespace
{

/// Deforms one particle by itself; false if its step is not admissible. Few need it, so that it stays out of the loop
/// below.
template <int D, class Update>
[[gnu::noinline]] bool deform_one(const DeformedParticles<D>& particles, std::size_t p)
{
  const StrainIncrement<D> step = strain_increment<D, Update>(particles.old_gradient[p], particles.g[p]);
  particles.deformation_gradient[p] = step.deformation_gradient;
  particles.volume[p] = particles.old_volume[p] * step.volume_ratio;
  particles.stress[p] = rotated<D>(particles.old_stress[p], step.rotation_increment);
  particles.strain_increment[p] = step.strain_increment;
  return step.admissible();
}

/// Flattened, as the functions that it calls for every few particles would otherwise pass values through memory.
template <int D, class Update>
[[gnu::flatten]] std::optional<std::size_t> deform_by(const DeformedParticles<D>& particles)
{
  const std::size_t n = particles.g.size();
  for (std::size_t first = 0; first < n; first += n_lanes) {
    const auto step =
        unchecked_increment<D, Lanes, Update>(lanes_at(particles.old_gradient, first), lanes_at(particles.g, first));
    set_lanes(particles.deformation_gradient, first, step.deformation_gradient);
    set_lanes(particles.volume, first, lanes_at(particles.old_volume, first) * step.volume_ratio);
    set_lanes(particles.stress, first, rotated<D>(lanes_at(particles.old_stress, first), step.rotation_increment));
    set_lanes(particles.strain_increment, first, step.strain_increment);
    const auto is_done = step.admissible() && step.rotates_to_round_off();
    if (!any(!is_done)) continue;
    for (std::size_t l = 0; l < std::min(n_lanes, n - first); ++l) {
      if (!is_done[l] && !deform_one<D, Update>(particles, first + l)) return first + l;
    }
  }
  return {};
}

}  // namespace

template <int D>
std::optional<std::size_t> deform(DeformationUpdate update, const DeformedParticles<D>& particles)
{
  return with_update(update, [&]<class Update>(const Update&) { return deform_by<D, Update>(particles); });
}

std::optional<std::size_t> stretch_hoops(DeformationUpdate update, const StretchedHoops& hoops)
{
  return with_update(update, [&]<class Update>(const Update&) -> std::optional<std::size_t> {
    for (std::size_t p = 0; p < hoops.g.size(); ++p) {
      const double ratio = Update::stretch(hoops.g[p]);
      if (!(ratio > 0)) return p;
      hoops.stretch[p] = ratio * hoops.old_stretch[p];
      hoops.volume[p] *= ratio;
      hoops.strain_increment[p][2] = Update::stretch_strain(hoops.g[p]);
    }
    return {};
  });
}

template std::optional<std::size_t> deform(DeformationUpdate, const DeformedParticles<2>&);
template std::optional<std::size_t> deform(DeformationUpdate, const DeformedParticles<3>&);

}  // namespace tamp::components
