#pragma once

#include <cstdint>
#include <span>

#include "components/contact/wall_gaps.hpp"

/// Loads of the matter beside walls, and the gaps that they cross.
namespace tamp::components
{

/// Loads of particles on the nodes of walls, sum S_ip V_p (-sigma_nn) [J]: all, and those that cross a gap.
struct WallLoads {
  double early = 0, whole = 0;
  /// The particle with the lowest id whose load crosses a gap; none is -1.
  std::ptrdiff_t first_early = -1;
};

/// Pressures beside walls.
template <int D>
struct LoadedParticles {
  std::span<const std::int64_t> id;
  ParticlePlaces<D> places;
  std::span<const double> volume;              ///< m3, a metre thick in the plane
  std::span<const SymmetricTensor<D>> stress;  ///< Pa, tension positive
};

/// The loads of particles in compression on walls. A load is early where more than a quarter of a cell is between the
/// wall and the material at the node, as `gaps` has it: an edge that cuts through the lattice of particles may seem so
/// much nearer than it is.
template <int D>
WallLoads wall_loads(const Interpolation<D>& interpolation, const GridBlock<D>& block,
                     const LoadedParticles<D>& particles, std::span<const PlaneWall> walls, const WallGaps<D>* gaps);

}  // namespace tamp::components
