#pragma once

namespace tamp::components
{

/// The particles of one material in a cell: what they fill, and how that changes in a step. All of them then change by
/// the mean, J_cell = sum V_p det f_p / sum V_p, which leaves the volume of the cell's matter what it is.
struct CellVolume {
  double volume = 0;         ///< sum V_p [m^D]
  double volume_change = 0;  ///< sum V_p (det f_p - 1) [m^D]

  void add(double of_particle, double change)
  {
    volume += of_particle;
    volume_change += of_particle * change;
  }
  /// J_cell - 1, of a cell with a particle.
  double mean_change() const { return volume_change / volume; }
};

}  // namespace tamp::components
