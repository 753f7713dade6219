#pragma once

#include "components/tensors.hpp"

namespace tamp::components
{

/// The particles of one material in a cell: what they fill, and the mean over that of what they share.
struct CellMean {
  double volume = 0;  ///< sum V_p [m^D]
  double sum = 0;     ///< sum V_p a_p

  void add(double of_particle, double value)
  {
    volume += of_particle;
    sum += of_particle * value;
  }
  /// sum V_p a_p / sum V_p, of a cell with a particle.
  double mean() const { return sum / volume; }
};

/// The stress that does work on changes of a particle's volume [Pa], tension positive: the mean of the normal stresses
/// along the axes that share a change, less the viscous pressure. Those are two in plane strain, three in space and of
/// rings.
template <int n_axes, class Stress>
double mean_stress(const Stress& stress, double viscous_pressure)
{
  return stress.template head<n_axes>().mean() - viscous_pressure;
}

/// The stress with another mean.
template <int n_axes, class Stress>
Stress with_mean_stress(Stress stress, double viscous_pressure, double mean)
{
  const double change = mean - mean_stress<n_axes>(stress, viscous_pressure);
  stress.template head<n_axes>().array() += change;
  return stress;
}

}  // namespace tamp::components
