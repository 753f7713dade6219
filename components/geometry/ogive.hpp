#pragma once

#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Tangent ogive: an arc of a circle that ends parallel to the axis, turned about it. From its pointed tip to the
/// centre of its base, whose radius is at most the length; at equal ones it is half of a ball. It holds no point of
/// its surface but the tip's end.
struct Ogive {
  Vector<3> tip;
  Vector<3> base;
  double radius;

  bool contains(const Vector<3>& x) const;
  double reach(const Vector<3>& direction) const;
  void faces(const Vector<3>& x, SurfacePoints<3>& points) const;
  Volume volume() const;
  void check() const;

 private:
  double length() const { return (base - tip).norm(); }
  /// Radius of the arc.
  double arc() const { return (radius * radius + length() * length()) / (2 * radius); }
};

}  // namespace tamp::components
