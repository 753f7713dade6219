#pragma once

#include <array>

#include "components/lanes.hpp"
#include "components/parameter.hpp"

namespace tamp::components
{

/// Pressure that spreads a shock over a few cells: J. von Neumann and R. D. Richtmyer, A method for the numerical
/// calculation of hydrodynamic shocks, J. Appl. Phys. 21, 1950, with a term linear in the rate that damps the ringing
/// behind it. Both coefficients are pure numbers, 0 or above.
struct ArtificialViscosity {
  double linear = 0.2;
  double quadratic = 2;

  static constexpr std::array<Parameter<ArtificialViscosity>, 2> parameters();

  /// q [Pa], compression positive: to be added to the pressure in the internal force, not to the stress. It is 0 while
  /// the material expands. Density [kg/m^3], bulk modulus [Pa, 0 or above], `volume_rate` = tr D [1/s, expansion
  /// positive], cell size [m].
  /// `Number` may be Lanes.
  template <class Number>
  Number pressure(const Number& density, const Number& bulk_modulus, const Number& volume_rate, double cell_size) const
  {
    const Number bulk_speed = sqrt(bulk_modulus / density);
    const Number closing_speed = -volume_rate * cell_size;
    const Number q = density * closing_speed * (linear * bulk_speed + quadratic * closing_speed);
    return select(volume_rate >= 0.0, Number(0.0), q);
  }
};

constexpr std::array<Parameter<ArtificialViscosity>, 2> ArtificialViscosity::parameters()
{
  return {{{"linear", "", zero_or_above, &ArtificialViscosity::linear, "its coefficient of the rate", true},
           {"quadratic", "", zero_or_above, &ArtificialViscosity::quadratic,
            "its coefficient of the square of the rate", true}}};
}

}  // namespace tamp::components
