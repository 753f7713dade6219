#pragma once

#include <istream>
#include <memory>

#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The inside of a surface of triangles that is closed and does not cross itself; several such surfaces, also one
/// in another, are one mesh. Whether a point is inside is found exactly; points of the surface are not.
/// A build without meshes (TAMP_MESHES) refuses every mesh.
class ClosedMesh
{
 public:
  /// Was this built with meshes?
  static const bool is_available;

  /// Reads STL, binary or text, whose coordinates are multiplied by `scale` to be metres. Points that are equal are one
  /// and the sense of the triangles does not matter, but for a surface in another, which has to face the other way, as
  /// that of a void does. Throws BadValue for text that is no STL, and for a surface that is open, crosses itself or
  /// holds nothing.
  ClosedMesh(std::istream& stl, double scale);

  bool contains(const Vector<3>& x) const;
  double reach(const Vector<3>& direction) const;
  void faces(const Vector<3>& x, SurfacePoints<3>& points) const;
  Volume volume() const;

 private:
  struct Surface;
  std::shared_ptr<const Surface> surface_;
};

}  // namespace tamp::components
