#pragma once

namespace tamp::components
{

/// Pressure that spreads a shock over a few cells: J. von Neumann and R. D. Richtmyer, A method for the numerical
/// calculation of hydrodynamic shocks, J. Appl. Phys. 21, 1950, with a term linear in the rate that damps the ringing
/// behind it. Both coefficients are pure numbers, 0 or above.
struct ArtificialViscosity {
  double linear = 0.2;
  double quadratic = 2;

  /// q [Pa], compression positive: to be added to the pressure in the internal force, not to the stress. It is 0 while
  /// the material expands. Density [kg/m^3], bulk modulus [Pa, 0 or above], `volume_rate` = tr D [1/s, expansion
  /// positive], cell size [m].
  double pressure(double density, double bulk_modulus, double volume_rate, double cell_size) const;
};

}  // namespace tamp::components
