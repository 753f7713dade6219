#pragma once

#include "components/tensors.hpp"

namespace tamp::components
{

/// A point in the coordinates of a body of revolution [m, m^2].
struct AxialPoint {
  double along;
  double radius_squared;
};

/// A straight line from `start` along the unit vector `direction`, about which a solid is a body of revolution.
struct Axis {
  Vector<3> start;
  Vector<3> direction;

  AxialPoint of(const Vector<3>& x) const
  {
    const Vector<3> from_start = x - start;
    const double along = from_start.dot(direction);
    return {along, (from_start - along * direction).squaredNorm()};
  }

  /// How far a circle about the axis, `along` it and of the given radius, reaches in a direction [m].
  double rim_reach(double along, double radius, const Vector<3>& towards) const
  {
    const double slant = direction.dot(towards);
    return start.dot(towards) + along * slant + radius * (towards - slant * direction).norm();
  }
};

}  // namespace tamp::components
