#pragma once

#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Box with faces along the axes; half open, lower <= x < upper, so that boxes that share a face share no point.
template <int D>
struct Box {
  Vector<D> lower;
  Vector<D> upper;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  void check() const;
};

/// Box of edge lengths `sides` turned about its centre: its local axes are the columns of `rotation`. Half open in
/// its local axes.
template <int D>
struct RotatedBox {
  Vector<D> centre;
  Vector<D> sides;
  Matrix<D> rotation;

  bool contains(const Vector<D>& x) const;
  double reach(const Vector<D>& direction) const;
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const;
  Volume volume() const;
  void check() const;
};

}  // namespace tamp::components
