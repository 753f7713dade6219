#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/errors.hpp"
#include "components/materials/soil_update.hpp"
#include "components/range.hpp"

/// Common parts of soils with constant moduli, an angle of friction and a cohesion.
namespace tamp::components
{

inline constexpr Range angle_range{.lower = 0, .upper = 90, .holds_upper = false};

inline double in_radians(double degrees)
{
  return degrees * std::numbers::pi / 180;
}

/// Throws BadParameter where the numbers of a soil do not go together.
template <class Soil>
void check_constant_soil(const Soil& soil)
{
  if (soil.dilation_angle > soil.friction_angle) {
    throw BadParameter(
        "dilation_angle", fmt::format("{}", soil.dilation_angle),
        fmt::format("at most the friction angle, {}: more would gain energy by flowing", soil.friction_angle));
  }
  if (soil.friction_angle == 0 && soil.cohesion == 0) {
    throw BadParameter("cohesion", "0 without friction", "a friction angle or a cohesion above 0");
  }
  // A cut-off at the apex is given with a few digits.
  constexpr double round_off = 1e-5;
  if (std::isfinite(soil.tension_cutoff) && soil.tension_cutoff > soil.apex_tension() * (1 + round_off)) {
    throw BadParameter("tension_cutoff", fmt::format("{}", soil.tension_cutoff),
                       fmt::format("at most {:.6g} Pa, where the cone ends", soil.apex_tension()));
  }
}

/// The trial stress of constant moduli.
template <int D>
SoilTrial<D> linear_trial(const TangentModuli& moduli, const SymmetricTensor<D, Lanes>& old,
                          const SymmetricTensor<D, Lanes>& strain)
{
  return {old + Lanes(2 * moduli.shear_modulus) * deviator(strain) +
              isotropic<n_symmetric<D>, Lanes>(moduli.bulk_modulus * trace(strain)),
          {moduli.bulk_modulus, moduli.shear_modulus},
          trace(old) / -3.0};
}

/// The numbers that describe such a soil, in the order in which they are documented.
template <class Soil>
inline constexpr std::array<Parameter<Soil>, 8> constant_soil_parameters{{
    {"bulk_modulus", "Pa", above_zero, &Soil::bulk_modulus, "constant"},
    {"shear_modulus", "Pa", above_zero, &Soil::shear_modulus, "constant"},
    {"friction_angle", "degrees", angle_range, &Soil::friction_angle, Soil::meaning_of_friction},
    {"dilation_angle", "degrees", angle_range, &Soil::dilation_angle,
     "how much it widens as it is sheared; at most the friction angle", true},
    {"cohesion", "Pa", zero_or_above, &Soil::cohesion, Soil::meaning_of_cohesion, true},
    {"tension_cutoff", "Pa", zero_or_above, &Soil::tension_cutoff,
     "mean tension that it bears at most; without it that of the cone's apex, cohesion / tan(friction angle)", true},
    {"dilation_limit", "", zero_or_above, &Soil::dilation_limit,
     "plastic volumetric expansion since the start beyond which it widens no more as it is sheared", true},
    {"separation", "", any_number, &Soil::separation,
     "whether grains part at the tension that it bears at most, and bear and resist nothing until the gaps have "
     "closed, "
     "see [sand.md](../explanation/sand.md#sand-that-separates)",
     true},
}};

}  // namespace tamp::components
