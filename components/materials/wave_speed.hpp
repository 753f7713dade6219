#pragma once

#include <type_traits>

#include "components/lanes.hpp"

namespace tamp::components
{

/// Speed of a dilatational wave, m/s, in a solid of these moduli (Pa) and density (kg/m3).
template <class Number>
Number wave_speed(const Number& bulk_modulus, const std::type_identity_t<Number>& shear_modulus,
                  const std::type_identity_t<Number>& density)
{
  return sqrt((bulk_modulus + 4.0 / 3.0 * shear_modulus) / density);
}

}  // namespace tamp::components
