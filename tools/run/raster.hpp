#pragma once

#include <array>
#include <vector>

namespace tamp::tools
{

/// A picture of particles in cells of one size; each cell shows the nearest of the particles that reach it.
class Raster
{
 public:
  static constexpr int nobody = -1;

  struct Cell {
    /// Material of the particle that it shows, or `nobody`.
    int material = nobody;
    double speed = 0;
    /// Distance of that particle.
    double distance = 0;
  };

  /// Makes the picture of a box, with `most` cells along its longer side. Throws std::out_of_range for what is no box.
  Raster(std::array<double, 2> lower, std::array<double, 2> upper, int most);

  /// A particle is a square that reaches so far from its middle, a cell at least; `off` is how far it is from the
  /// plane of the picture.
  void add(std::array<double, 2> position, double reach, double off, int material, double speed);

  std::array<int, 2> n_cells() const { return n_; }
  double cell_size() const { return size_; }
  /// Row by row from below.
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::array<double, 2> lower_;
  double size_;
  std::array<int, 2> n_;
  std::vector<Cell> cells_;
};

}  // namespace tamp::tools
