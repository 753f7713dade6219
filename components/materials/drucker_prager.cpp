#include "components/materials/drucker_prager.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

/// The numbers of the yield surface and the flow, see DruckerPrager.
struct Cone {
  double alpha, k, beta;
  double tension;  ///< the greatest mean tension

  explicit Cone(const DruckerPrager& soil)
      : alpha(slope_of(soil.friction_angle)),
        k(soil.cohesion * 2 * std::numbers::sqrt3 * portable::cos(radians(soil.friction_angle)) /
          (3 - portable::sin(radians(soil.friction_angle)))),
        beta(slope_of(soil.dilation_angle)),
        tension(std::min(soil.tension_cutoff, alpha > 0 ? k / alpha : std::numeric_limits<double>::infinity()))
  {
  }

  double strength(double pressure) const { return k + alpha * pressure; }

 private:
  static double radians(double degrees) { return degrees * std::numbers::pi / 180; }
  static double slope_of(double angle)
  {
    const double sine = portable::sin(radians(angle));
    return 2 * std::numbers::sqrt3 * sine / (3 - sine);
  }
};

/// Where a trial stress ends, and how it flowed.
struct Returned {
  double pressure;
  double sqrt_j2;
  double plastic_shear = 0;      ///< times s / (2 sqrt(J2)) it is the deviator of the plastic strain
  double plastic_expansion = 0;  ///< volumetric
};

Returned returned(const DruckerPrager& soil, const Cone& cone, const Invariants& trial)
{
  const double K = soil.bulk_modulus, G = soil.shear_modulus, tau = trial.sqrt_j2();
  const double beyond_cone = tau - cone.strength(trial.pressure);
  if (beyond_cone <= 0 && trial.pressure >= -cone.tension) return {trial.pressure, tau};
  if (beyond_cone > 0) {
    const double shear = beyond_cone / (G + cone.alpha * cone.beta * K);
    const double pressure = trial.pressure + K * cone.beta * shear;
    // Below the cut-off there is shear left; where it is next to nothing, round-off may say less.
    if (pressure >= -cone.tension) return {pressure, std::max(tau - shear * G, 0.0), shear, cone.beta * shear};
  }
  // At the cut-off, where the cone may hold the shear.
  const double held = std::min(tau, std::max(cone.strength(-cone.tension), 0.0));
  return {-cone.tension, held, (tau - held) / G, (-cone.tension - trial.pressure) / K};
}

constexpr Range angle{.lower = 0, .upper = 90, .holds_upper = false};
constexpr std::array<Parameter<DruckerPrager>, 6> soil_parameters{{
    {"bulk_modulus", "Pa", above_zero, &DruckerPrager::bulk_modulus, "constant"},
    {"shear_modulus", "Pa", above_zero, &DruckerPrager::shear_modulus, "constant"},
    {"friction_angle", "degrees", angle, &DruckerPrager::friction_angle,
     "Mohr and Coulomb's, in triaxial compression; from 0 to below 90"},
    {"dilation_angle", "degrees", angle, &DruckerPrager::dilation_angle,
     "how much it widens as it is sheared; at most the friction angle", true},
    {"cohesion", "Pa", zero_or_above, &DruckerPrager::cohesion,
     "Mohr and Coulomb's, in triaxial compression; above 0 where there is no friction", true},
    {"tension_cutoff", "Pa", zero_or_above, &DruckerPrager::tension_cutoff,
     "mean tension that it bears at most; without it that of the cone's apex, cohesion / tan(friction angle)", true},
}};

constexpr std::array<StateColumn<DruckerPrager>, 2> soil_columns{{
    {"plastic_volumetric", "-",
     [](const DruckerPrager&, const DruckerPragerState& s, const Invariants&) { return s.plastic_volumetric; }},
    {"equivalent_plastic", "-",
     [](const DruckerPrager&, const DruckerPragerState& s, const Invariants&) { return s.equivalent_plastic; }},
}};
constexpr std::array<StateExtreme, 3> soil_extremes{{{.column = 0}, {.column = 0, .greatest = false}, {.column = 1}}};

}  // namespace

std::span<const Parameter<DruckerPrager>, 6> DruckerPrager::parameters()
{
  return soil_parameters;
}

std::span<const StateColumn<DruckerPrager>, 2> DruckerPrager::columns()
{
  return soil_columns;
}

std::span<const StateExtreme, 3> DruckerPrager::extremes()
{
  return soil_extremes;
}

double DruckerPrager::apex_tension() const
{
  const Cone cone(*this);
  return cone.alpha > 0 ? cone.k / cone.alpha : std::numeric_limits<double>::infinity();
}

void DruckerPrager::check() const
{
  if (dilation_angle > friction_angle) {
    throw BadParameter(
        "dilation_angle", fmt::format("{}", dilation_angle),
        fmt::format("at most the friction angle, {}: more would gain energy by flowing", friction_angle));
  }
  if (friction_angle == 0 && cohesion == 0) {
    throw BadParameter("cohesion", "0 without friction", "a friction angle or a cohesion above 0");
  }
  // A cut-off at the apex is given with a few digits.
  constexpr double round_off = 1e-5;
  if (std::isfinite(tension_cutoff) && tension_cutoff > apex_tension() * (1 + round_off)) {
    throw BadParameter("tension_cutoff", fmt::format("{}", tension_cutoff),
                       fmt::format("at most {:.6g} Pa, where the cone ends", apex_tension()));
  }
}

template <int D>
BatchFailure update(const DruckerPrager& soil, const MaterialBatch<D, DruckerPragerState>& batch, UpdateCounts& counts)
{
  const Cone cone(soil);
  BatchFailure first_failure;
  for (std::size_t i = 0; i < batch.stress.size(); ++i) {
    batch.bulk_modulus[i] = soil.bulk_modulus;
    batch.shear_modulus[i] = soil.shear_modulus;
    batch.plastic_work[i] = 0;
    batch.state[i] = batch.old_state[i];
    const SymmetricTensor<D>& strain = batch.strain_increment[i];
    const SymmetricTensor<D> trial = batch.stress[i] + 2 * soil.shear_modulus * deviator(strain) +
                                     isotropic<n_symmetric<D>>(soil.bulk_modulus * trace(strain));
    if (!trial.allFinite()) {
      if (!first_failure) first_failure = UpdateFailure{i, UpdateFault::not_finite};
      ++counts.failures;
      continue;
    }
    const Invariants before = invariants(trial);
    const Returned now = returned(soil, cone, before);
    const double kept = before.j2 > 0 ? now.sqrt_j2 / before.sqrt_j2() : 1;
    batch.stress[i] = kept * deviator(trial) - isotropic<n_symmetric<D>>(now.pressure);
    batch.state[i].plastic_volumetric -= now.plastic_expansion;
    batch.state[i].equivalent_plastic += now.plastic_shear / std::numbers::sqrt3;
    batch.plastic_work[i] = now.sqrt_j2 * now.plastic_shear - now.pressure * now.plastic_expansion;
    ++counts.substeps;
  }
  return first_failure;
}

template BatchFailure update<2>(const DruckerPrager&, const MaterialBatch<2, DruckerPragerState>&, UpdateCounts&);
template BatchFailure update<3>(const DruckerPrager&, const MaterialBatch<3, DruckerPragerState>&, UpdateCounts&);

}  // namespace tamp::components
