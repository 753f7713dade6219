#include "components/geometry/section.hpp"

#include <cmath>

namespace tamp::components
{

void Section::faces(const Vector<2>& x, SurfacePoints<2>& points) const
{
  thread_local SurfacePoints<3> of_solid;
  of_solid.clear();
  const Vector<3> place(x[0], x[1], 0);
  solid.faces(place, of_solid);
  for (const SurfacePoint<3>& point : of_solid) {
    const Vector<2> slope = point.normal.head<2>();
    const double steepness = slope.norm();
    constexpr double flat = 1e-6;
    if (steepness < flat) continue;  // a face along the plane has no line in it
    const Vector<2> normal = slope / steepness;
    const bool is_in_plane = std::abs(point.at[2]) <= 1e-12 * (place - point.at).norm() + 1e-15;
    const double distance = (place - point.at).dot(point.normal) / steepness;
    points.push_back({is_in_plane ? Vector<2>(point.at.head<2>()) : Vector<2>(x - distance * normal), normal});
  }
}

}  // namespace tamp::components
