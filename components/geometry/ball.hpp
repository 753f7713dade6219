#pragma once

#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Disk in the plane, sphere in space; open: a point at the radius is outside.
template <int D>
struct Ball {
  Vector<D> centre;
  double radius;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  void check() const;
};

}  // namespace tamp::components
