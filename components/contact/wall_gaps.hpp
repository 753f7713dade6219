#pragma once

#include <span>

#include "components/shapes/grid_block.hpp"
#include "components/shapes/interpolation.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/tensors.hpp"

/// Contact of matter with plane walls of the grid where the edges of its particles touch them.
namespace tamp::components
{

/// A wall normal to `axis`, with matter on one side of it.
struct PlaneWall {
  int axis;
  int outside;   ///< -1: matter lies above the wall, +1: below
  double place;  ///< coordinate of the wall on the axis [m]

  /// The place of the wall among those of a grid.
  std::size_t number() const { return 2 * static_cast<std::size_t>(axis) + (outside > 0 ? 1 : 0); }
  template <int D>
  double distance(const Vector<D>& x) const
  {
    return outside * (place - x[axis]);
  }
};

/// Sums over the particles of a material near each wall of the grid, at the nodes that they reach: as those near a
/// rigid body's solid (GapSums), the nearest particles count most.
template <int D>
struct WallGaps : NodeValues<D, 4 * D> {
  /// 0 where no particle near the wall reaches the node.
  double weight(const PlaneWall& wall) const { return this->values[at(wall)]; }
  /// The soft minimum of the gaps between particles and wall [m]; below 0 where they overlap.
  double gap(const PlaneWall& wall) const { return this->values[at(wall) + 1] / weight(wall); }

  WallGaps& operator+=(const WallGaps& other)
  {
    this->values += other.values;
    return *this;
  }
  WallGaps mirrored(int) const { return *this; }

  static int at(const PlaneWall& wall) { return 2 * static_cast<int>(wall.number()); }
};

/// Adds the particles within two cells of a wall to the sums of their nodes. Particles are `size` [m] long along each
/// axis at first.
template <int D>
void add_wall_gaps(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                   double size, std::span<const PlaneWall> walls, WallGaps<D>* sums);

}  // namespace tamp::components
