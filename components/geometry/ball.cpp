#include "components/geometry/ball.hpp"

#include <numbers>

#include "components/geometry/checks.hpp"

namespace tamp::components
{

template <int D>
bool Ball<D>::contains(const Vector<D>& x) const
{
  return (x - centre).squaredNorm() < radius * radius;
}

template <int D>
double Ball<D>::reach(const Vector<D>& direction) const
{
  return centre.dot(direction) + radius * direction.norm();
}

template <int D>
void Ball<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  const Vector<D> from_centre = x - centre;
  const double length = from_centre.norm();
  const Vector<D> normal = length > 0 ? Vector<D>(from_centre / length) : Vector<D>(Vector<D>::Unit(0));
  points.push_back({centre + radius * normal, normal});
}

template <int D>
Volume Ball<D>::volume() const
{
  const double disk = std::numbers::pi * radius * radius;
  return {D == 2 ? disk : 4.0 / 3.0 * disk * radius};
}

template <int D>
void Ball<D>::check() const
{
  require_finite<D>(centre, "centre");
  require_positive(radius, "radius");
}

template struct Ball<2>;
template struct Ball<3>;

}  // namespace tamp::components
