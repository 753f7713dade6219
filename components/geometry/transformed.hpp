#pragma once

#include "components/geometry/solid.hpp"

namespace tamp::components
{

/// A solid that is turned about the origin and then moved.
template <int D>
struct Transformed {
  Solid<D> solid;
  Matrix<D> rotation;
  Vector<D> translation;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  std::size_t n_shapes() const { return solid.n_shapes(); }
  void check() const;
};

}  // namespace tamp::components
