#include "components/materials/hypoelastic.hpp"

#include <cmath>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

void check(const Hypoelastic& solid)
{
  if (!(std::isfinite(solid.bulk_modulus) && solid.bulk_modulus > 0)) {
    throw BadValue("bulk modulus " + std::to_string(solid.bulk_modulus), "a positive number of Pa");
  }
  if (!(std::isfinite(solid.shear_modulus) && solid.shear_modulus > 0)) {
    throw BadValue("shear modulus " + std::to_string(solid.shear_modulus), "a positive number of Pa");
  }
}

}  // namespace tamp::components
