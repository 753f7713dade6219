#pragma once

#include "components/geometry/sampled_volume.hpp"
#include "components/geometry/solid.hpp"

namespace tamp::components
{

/// The section of a solid of space with the plane z = 0.
struct Section {
  Solid<3> solid;

  bool contains(const Vector<2>& x) const { return solid.contains({x[0], x[1], 0}); }
  double reach(const Vector<2>& direction) const { return solid.reach({direction[0], direction[1], 0}); }
  /// Exact where the nearest point of the solid lies in the plane, as that of bodies of revolution whose axis does, or
  /// on a flat face; else to first order in the distance.
  void faces(const Vector<2>& x, SurfacePoints<2>& points) const;
  /// Its area.
  Volume volume() const
  {
    return sampled_volume<2>(Solid<2>(*this).bounding_box(), [this](const Vector<2>& x) { return contains(x); });
  }
  std::size_t n_shapes() const { return solid.n_shapes(); }
};

}  // namespace tamp::components
