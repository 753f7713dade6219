#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"

namespace tamp::components
{

/// A bar along x in uniaxial strain, undeformed, starts in one of its modes: v = speed sin(wave_number x), for small
/// strains. Held at x = 0, with smooth walls along it, it swings as
///
///     u = speed / omega sin(wave_number x) sin(omega t),    omega^2 = wave_number^2 (K + 4/3 G) / density,
///
/// if its other end is held and wave_number times its length is a whole number of pi, or free and half a pi more or
/// less. A bar that goes around a periodic domain a whole number of wave lengths long may drift along besides, which
/// adds the velocity `drift` and the displacement drift t.
struct VibratingBar {
  static constexpr std::string_view type = "vibrating_bar";
  static constexpr std::string_view meaning =
      "an elastic bar along x in uniaxial strain, which starts with the velocity speed sin(wave_number x) + drift. The "
      "exact solution is that of small strains, of a bar held at x = 0 in one of its modes, or of one that drifts "
      "around a periodic domain of a whole number of wave lengths";
  static constexpr std::array<Parameter<VibratingBar>, 3> parameters();

  double speed;        ///< m/s
  double wave_number;  ///< rad/m
  double drift = 0;    ///< m/s

  /// The material is elastic.
  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<Parameter<VibratingBar>, 3> VibratingBar::parameters()
{
  return {{{"speed", "m/s", any_number, &VibratingBar::speed},
           {"wave_number", "rad/m", above_zero, &VibratingBar::wave_number},
           {"drift", "m/s", any_number, &VibratingBar::drift, "", true}}};
}

}  // namespace tamp::components
