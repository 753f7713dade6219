#include "components/geometry/surface_point.hpp"

#include <algorithm>

namespace tamp::components
{

SurfacePoint<2> nearest_of_edge(const Vector<2>& from, const Vector<2>& to, const Vector<2>& x)
{
  const Vector<2> edge = to - from;
  const double along = std::clamp((x - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return {from + along * edge, Vector<2>(edge[1], -edge[0]).normalized()};
}

}  // namespace tamp::components
