#include "components/geometry/box.hpp"

#include <span>

#include "components/errors.hpp"
#include "components/geometry/checks.hpp"

namespace tamp::components
{

template <int D>
bool Box<D>::contains(const Vector<D>& x) const
{
  return (lower.array() <= x.array()).all() && (x.array() < upper.array()).all();
}

template <int D>
double Box<D>::reach(const Vector<D>& direction) const
{
  return lower.cwiseProduct(direction).cwiseMax(upper.cwiseProduct(direction)).sum();
}

template <int D>
void Box<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  const Vector<D> within = x.cwiseMax(lower).cwiseMin(upper);
  for (int k = 0; k < D; ++k) {
    points.push_back({within, -Vector<D>::Unit(k)});
    points.back().at[k] = lower[k];
    points.push_back({within, Vector<D>::Unit(k)});
    points.back().at[k] = upper[k];
  }
}

template <int D>
Volume Box<D>::volume() const
{
  return {(upper - lower).prod()};
}

template <int D>
void Box<D>::check() const
{
  require_finite<D>(lower, "lower corner");
  require_finite<D>(upper, "upper corner");
  if (!(lower.array() < upper.array()).all()) {
    throw BadValue("box from " + text<D>(lower) + " to " + text<D>(upper), "lower < upper along every axis");
  }
}

template <int D>
bool RotatedBox<D>::contains(const Vector<D>& x) const
{
  const Vector<D> local = rotation.transpose() * (x - centre);
  return Box<D>{-0.5 * sides, 0.5 * sides}.contains(local);
}

template <int D>
double RotatedBox<D>::reach(const Vector<D>& direction) const
{
  return centre.dot(direction) + 0.5 * sides.dot((rotation.transpose() * direction).cwiseAbs());
}

template <int D>
void RotatedBox<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  const std::size_t before = points.size();
  Box<D>{-0.5 * sides, 0.5 * sides}.faces(rotation.transpose() * (x - centre), points);
  for (SurfacePoint<D>& point : std::span(points).subspan(before)) {
    point = {centre + rotation * point.at, rotation * point.normal};
  }
}

template <int D>
Volume RotatedBox<D>::volume() const
{
  return {sides.prod()};
}

template <int D>
void RotatedBox<D>::check() const
{
  require_finite<D>(centre, "centre");
  for (int k = 0; k < D; ++k) require_positive(sides[k], "side");
  require_rotation<D>(rotation);
}

template struct Box<2>;
template struct Box<3>;
template struct RotatedBox<2>;
template struct RotatedBox<3>;

}  // namespace tamp::components
