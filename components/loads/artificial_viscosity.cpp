#include "components/loads/artificial_viscosity.hpp"

#include <cmath>

namespace tamp::components
{

double ArtificialViscosity::pressure(double density, double bulk_modulus, double volume_rate, double cell_size) const
{
  if (volume_rate >= 0) return 0;
  const double bulk_speed = std::sqrt(bulk_modulus / density);
  const double closing_speed = -volume_rate * cell_size;
  return density * closing_speed * (linear * bulk_speed + quadratic * closing_speed);
}

}  // namespace tamp::components
