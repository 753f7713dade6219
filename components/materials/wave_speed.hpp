#pragma once

#include <cmath>

namespace tamp::components
{

/// Speed of a dilatational wave, m/s, in a solid of these moduli (Pa) and density (kg/m3).
inline double wave_speed(double bulk_modulus, double shear_modulus, double density)
{
  return std::sqrt((bulk_modulus + 4.0 / 3.0 * shear_modulus) / density);
}

}  // namespace tamp::components
