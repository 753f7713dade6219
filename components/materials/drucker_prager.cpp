#include "components/materials/drucker_prager.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/portable_math.hpp"
#include "components/tensor_lanes.hpp"

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

  template <class Number>
  Number strength(const Number& pressure) const
  {
    return k + alpha * pressure;
  }

 private:
  static double radians(double degrees) { return degrees * std::numbers::pi / 180; }
  static double slope_of(double angle)
  {
    const double sine = portable::sin(radians(angle));
    return 2 * std::numbers::sqrt3 * sine / (3 - sine);
  }
};

/// Where a trial stress ends, and how it flowed.
template <class Number>
struct Returned {
  Number pressure;
  Number sqrt_j2;
  Number plastic_shear;      ///< times s / (2 sqrt(J2)) it is the deviator of the plastic strain
  Number plastic_expansion;  ///< volumetric
};

/// Without a branch, so that `Number` may be Lanes. `tau` is the trial's sqrt(J2).
template <class Number>
Returned<Number> returned(const DruckerPrager& soil, const Cone& cone, const Number& trial_pressure, const Number& tau)
{
  const double K = soil.bulk_modulus, G = soil.shear_modulus;
  const Number zero = 0.0, cut_off = -cone.tension;
  const Number beyond_cone = tau - cone.strength(trial_pressure);
  const Mask<Number> is_elastic = beyond_cone <= 0.0 && trial_pressure >= cut_off;

  const Number shear = beyond_cone / (G + cone.alpha * cone.beta * K);
  const Number pressure = trial_pressure + K * cone.beta * shear;
  const Mask<Number> is_on_cone = beyond_cone > 0.0 && pressure >= cut_off;
  // Below the cut-off there is shear left; where it is next to nothing, round-off may say less.
  const Number left = greater_of<Number>(tau - shear * G, zero);
  // At the cut-off, where the cone may hold the shear.
  const Number held = lesser_of<Number>(tau, greater_of<Number>(cone.strength(cut_off), zero));

  const auto chosen = [&](const Number& elastic, const Number& on_cone, const Number& at_cut_off) {
    return select(is_elastic, elastic, select(is_on_cone, on_cone, at_cut_off));
  };
  return {chosen(trial_pressure, pressure, cut_off), chosen(tau, left, held), chosen(zero, shear, (tau - held) / G),
          chosen(zero, cone.beta * shear, (cut_off - trial_pressure) / K)};
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
  std::ranges::fill(batch.bulk_modulus, soil.bulk_modulus);
  std::ranges::fill(batch.shear_modulus, soil.shear_modulus);
  BatchFailure first_failure;
  for (std::size_t i = 0; i < batch.stress.size(); i += n_lanes) {
    const SymmetricTensor<D, Lanes> strain = lanes_at(batch.strain_increment, i);
    const SymmetricTensor<D, Lanes> old = lanes_at(batch.stress, i);
    const SymmetricTensor<D, Lanes> trial = old + Lanes(2 * soil.shear_modulus) * deviator(strain) +
                                            isotropic<n_symmetric<D>, Lanes>(soil.bulk_modulus * trace(strain));
    const SymmetricTensor<D, Lanes> shearing = deviator(trial);
    const Lanes j2 = 0.5 * double_dot(shearing, shearing), tau = sqrt(j2);
    const Returned<Lanes> now = returned<Lanes>(soil, cone, -trace(trial) / 3, tau);
    const Lanes kept = select(j2 > 0.0, now.sqrt_j2 / tau, Lanes(1.0));
    const SymmetricTensor<D, Lanes> stress = kept * shearing - isotropic<n_symmetric<D>, Lanes>(now.pressure);
    const Lanes work = now.sqrt_j2 * now.plastic_shear - now.pressure * now.plastic_expansion;

    Lanes::mask_type finite = is_finite(trial[0]);
    for (int k = 1; k < n_symmetric<D>; ++k) finite = finite && is_finite(trial[k]);
    set_lanes<n_symmetric<D>, 1>(batch.stress, i, stress.binaryExpr(old, [&](const Lanes& to, const Lanes& from) {
      return select(finite, to, from);
    }));
    set_lanes(batch.plastic_work, i, select(finite, work, Lanes(0.0)));
    const Lanes expansion = select(finite, now.plastic_expansion, Lanes(0.0));
    const Lanes equivalent = select(finite, now.plastic_shear / std::numbers::sqrt3, Lanes(0.0));
    for (std::size_t l = 0; l < n_lanes && i + l < batch.state.size(); ++l) {
      const auto& [plastic_volumetric, equivalent_plastic] = batch.old_state[i + l];
      batch.state[i + l] = {plastic_volumetric - expansion[l], equivalent_plastic + equivalent[l]};
      if (finite[l]) {
        ++counts.substeps;
      } else {
        if (!first_failure) first_failure = UpdateFailure{i + l, UpdateFault::not_finite};
        ++counts.failures;
      }
    }
  }
  return first_failure;
}

template BatchFailure update<2>(const DruckerPrager&, const MaterialBatch<2, DruckerPragerState>&, UpdateCounts&);
template BatchFailure update<3>(const DruckerPrager&, const MaterialBatch<3, DruckerPragerState>&, UpdateCounts&);

}  // namespace tamp::components
