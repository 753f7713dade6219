#pragma once

#include <vector>

#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Region of the plane within straight edges that do not touch but at the corners they share. Half open: it holds the
/// edges on its lower sides, so that polygons that share an edge share no point.
class Polygon
{
 public:
  /// Corners in either sense. Throws BadValue, with the row of the corner, for edges that cross or touch.
  explicit Polygon(std::vector<Vector<2>> corners);

  bool contains(const Vector<2>& x) const;
  double reach(const Vector<2>& direction) const;
  void faces(const Vector<2>& x, SurfacePoints<2>& points) const;
  Volume volume() const;

 private:
  std::vector<Vector<2>> corners_;
  /// In this sense the inside is on the left of the edges.
  bool is_counterclockwise_;
};

/// Prism on a polygon of the x-y plane, lower <= z < upper.
struct ExtrudedPolygon {
  Polygon base;
  double lower;
  double upper;

  bool contains(const Vector<3>& x) const;
  double reach(const Vector<3>& direction) const;
  void faces(const Vector<3>& x, SurfacePoints<3>& points) const;
  Volume volume() const;
  void check() const;
};

}  // namespace tamp::components
