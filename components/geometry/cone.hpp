#pragma once

#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Right circular cylinder between the centres of its two ends; it holds its first end and not its second, and no
/// point at its radius.
struct Cylinder {
  Vector<3> first_end;
  Vector<3> second_end;
  double radius;

  bool contains(const Vector<3>& x) const;
  double reach(const Vector<3>& direction) const;
  void faces(const Vector<3>& x, SurfacePoints<3>& points) const;
  Volume volume() const;
  void check() const;
};

/// Right circular cone between the centres of its two ends, whose radii may be anything but both 0; it holds its first
/// end and not its second, and no point at its radius.
struct Cone {
  Vector<3> first_end;
  Vector<3> second_end;
  double first_radius;
  double second_radius;

  bool contains(const Vector<3>& x) const;
  double reach(const Vector<3>& direction) const;
  void faces(const Vector<3>& x, SurfacePoints<3>& points) const;
  Volume volume() const;
  void check() const;
};

}  // namespace tamp::components
