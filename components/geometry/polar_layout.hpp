#pragma once

#include <vector>

#include "components/tensors.hpp"

namespace tamp::components
{

/// Where a particle of a body lies, and its share of the body [m^3]; in the plane of one metre of thickness.
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

  /// From the inner ring to the outer one, anticlockwise.
  std::vector<Site<2>> sites(double spacing) const;
  /// The rotation from x and y to outwards and around, as a sector at `place` lies, which is not the centre.
  Matrix<2> axes_at(const Vector<2>& place) const;
};

}  // namespace tamp::components
