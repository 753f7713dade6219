#pragma once

#include <cmath>
#include <limits>

#include "components/loads/artificial_viscosity.hpp"
#include "components/tensors.hpp"

/// Bounds on the time step [s] from one particle or one contact, before any safety factor; the step is the least of
/// them over all. Cell size in m, speeds in m/s.
namespace tamp::components
{

/// The rule of the published runs: no signal and no particle crosses a cell, axis by axis.
template <int D>
double published_time_step(double cell_size, double wave_speed, const Vector<D>& velocity)
{
  return cell_size / (wave_speed + velocity.cwiseAbs().maxCoeff());
}

/// The rule that counts artificial viscosity too. The viscosity damps the highest mode of the grid by the ratio
/// zeta = C0 + C1 h max(0, -tr D) / c, and central differences that lag the damping by half a step then allow
/// sqrt(1 + zeta^2) - zeta of the undamped step. `volume_rate` = tr D [1/s, expansion positive].
template <int D>
double viscous_time_step(double cell_size, double wave_speed, const Vector<D>& velocity, double volume_rate,
                         const ArtificialViscosity& viscosity)
{
  const double closing_speed = cell_size * std::fmax(0, -volume_rate);
  const double zeta = viscosity.linear + viscosity.quadratic * closing_speed / wave_speed;
  // 1 / (sqrt(1 + zeta^2) + zeta) is sqrt(1 + zeta^2) - zeta without the cancellation at large zeta.
  return cell_size / (wave_speed + velocity.norm()) / (std::hypot(1.0, zeta) + zeta);
}

/// The part of the bound above that particles leave. In each step particles hand back to the nodes only the share
/// r = (1 - 1/n^2) / 3 of the velocity that they took from the shortest wave (+1 and -1 from node to node), n being
/// particles along each axis of a cell: that is the mean square of the wave, linear between nodes, averaged over each
/// particle. Leapfrog of the rest, which the nodes forget, is stable up to h / (c sqrt(2 - r)).
inline double transfer_step_factor(int n_per_axis)
{
  const double n = n_per_axis;
  return std::sqrt(3 / (5 + 1 / (n * n)));
}

/// Bodies that meet at `approach_speed` close no more than a tenth of a cell in a step, so that what they meet is
/// strained by no more than that at once; no bound if they do not approach.
inline double contact_time_step(double cell_size, double approach_speed)
{
  return approach_speed > 0 ? 0.1 * cell_size / approach_speed : std::numeric_limits<double>::infinity();
}

}  // namespace tamp::components
