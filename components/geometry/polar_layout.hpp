#pragma once

#include <optional>
#include <vector>

#include "components/geometry/box.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Where a particle of a body lies, and its share of the body [m^3]; in the plane of one metre of thickness, or of what
/// turning it about the axis x = 0 makes of it.
template <int D>
struct Site {
  Vector<D> place;
  double volume;
};

/// Particles on rings about a centre in the plane. The rings are of one width, that of `spacing` rounded so that they
/// fill the region between both radii; each is cut into equal sectors about as long as it is wide, at least three. A
/// particle lies in the middle of its sector, the first of a ring half a sector from the x axis, and has its volume, so
/// that all together have the ring's. Lengths in m, 0 <= inner_radius < outer_radius.
struct PolarLayout {
  Vector<2> centre;
  double inner_radius;
  double outer_radius;
  /// The half or quarter that planes of symmetry through the centre, normal to x or y, leave of it; no sector reaches
  /// across them.
  std::optional<Box<2>> part{};

  /// From the inner ring to the outer one, anticlockwise. Volumes are those of rings about the axis if `revolved`.
  std::vector<Site<2>> sites(double spacing, bool revolved) const;
  /// The rotation from x and y to outwards and around, as a sector at `place` lies, which is not the centre.
  Matrix<2> axes_at(const Vector<2>& place) const;
};

}  // namespace tamp::components
