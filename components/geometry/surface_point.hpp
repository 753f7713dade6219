#pragma once

#include <vector>

#include "components/tensors.hpp"

namespace tamp::components
{

/// A point of a surface [m], and the unit normal there, which points out of the solid.
template <int D>
struct SurfacePoint {
  Vector<D> at;
  Vector<D> normal;
};

/// The points nearest to a given one, one for each face of a solid.
template <int D>
using SurfacePoints = std::vector<SurfacePoint<D>>;

/// Distance of a point from a surface [m], below 0 within the solid, and the direction in which it grows the fastest:
/// at a face its normal. x - value * normal is the nearest point.
template <int D>
struct SignedDistance {
  double value;
  Vector<D> normal;
};

/// The point of the straight edge between two points of the plane that is nearest to x. The solid lies on its left.
SurfacePoint<2> nearest_of_edge(const Vector<2>& from, const Vector<2>& to, const Vector<2>& x);

}  // namespace tamp::components
