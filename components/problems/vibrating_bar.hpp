#pragma once

#include <array>
#include <string_view>

#include "components/problems/body_functions.hpp"
#include "components/problems/problem_parameter.hpp"

namespace tamp::components
{

/// A bar along x in uniaxial strain, undeformed, starts in one of its modes: v = speed sin(wave_number x), for small
/// strains. Held at x = 0, with smooth walls along it, it swings as
///
///     u = speed / omega sin(wave_number x) sin(omega t),    omega^2 = wave_number^2 (K + 4/3 G) / density,
///
/// if its other end is held and wave_number times its length is a whole number of pi, or free and half a pi more or
/// less.
struct VibratingBar {
  static constexpr std::string_view type = "vibrating_bar";
  static constexpr std::string_view meaning =
      "an elastic bar along x in uniaxial strain, which starts with the velocity speed sin(wave_number x). The exact "
      "solution is that of small strains, of a bar held at x = 0 in one of its modes";
  static constexpr std::array<ProblemParameter<VibratingBar>, 2> parameters();

  double speed;        ///< m/s
  double wave_number;  ///< rad/m

  /// The material is elastic.
  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<ProblemParameter<VibratingBar>, 2> VibratingBar::parameters()
{
  return {{{"speed", "m/s", any_number, &VibratingBar::speed},
           {"wave_number", "rad/m", above_zero, &VibratingBar::wave_number}}};
}

}  // namespace tamp::components
