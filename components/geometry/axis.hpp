#pragma once

#include <Eigen/Geometry>

#include "components/geometry/surface_point.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// A point in the coordinates of a body of revolution [m, m^2].
struct AxialPoint {
  double along;
  double radius_squared;
};

/// The half plane of a body of revolution that holds a point: places in it are (along, radius).
struct MeridianPlane {
  Vector<3> start, direction;
  /// From the axis to the point; for a point on the axis any.
  Vector<3> outward;
  /// The point itself.
  Vector<2> place;

  SurfacePoint<3> in_space(const SurfacePoint<2>& point) const
  {
    return {start + point.at[0] * direction + point.at[1] * outward,
            point.normal[0] * direction + point.normal[1] * outward};
  }
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

  MeridianPlane plane_of(const Vector<3>& x) const
  {
    const Vector<3> from_start = x - start;
    const double along = from_start.dot(direction);
    const Vector<3> across = from_start - along * direction;
    const double radius = across.norm();
    return {start, direction, radius > 0 ? Vector<3>(across / radius) : direction.unitOrthogonal(), {along, radius}};
  }

  /// How far a circle about the axis, `along` it and of the given radius, reaches in a direction [m].
  double rim_reach(double along, double radius, const Vector<3>& towards) const
  {
    const double slant = direction.dot(towards);
    return start.dot(towards) + along * slant + radius * (towards - slant * direction).norm();
  }
};

}  // namespace tamp::components
