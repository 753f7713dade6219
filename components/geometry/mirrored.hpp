#pragma once

#include "components/geometry/solid.hpp"

namespace tamp::components
{

/// A solid on one side of a plane of symmetry with its image on the other: what lies on the plane is no surface.
template <int D>
struct Mirrored {
  Solid<D> half;
  int axis;
  double plane;
  /// -1 where the half lies above the plane, +1 where it lies below.
  int outside;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  std::size_t n_shapes() const { return half.n_shapes(); }

 private:
  bool is_beyond(const Vector<D>& x) const { return outside * (x[axis] - plane) > 0; }
  Vector<D> image(const Vector<D>& x) const;
};

}  // namespace tamp::components
