#include "components/geometry/transformed.hpp"

#include <span>

#include "components/geometry/checks.hpp"

namespace tamp::components
{

template <int D>
bool Transformed<D>::contains(const Vector<D>& x) const
{
  return solid.contains(rotation.transpose() * (x - translation));
}

template <int D>
double Transformed<D>::reach(const Vector<D>& direction) const
{
  return solid.reach(rotation.transpose() * direction) + translation.dot(direction);
}

template <int D>
void Transformed<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  const std::size_t before = points.size();
  solid.faces(rotation.transpose() * (x - translation), points);
  for (SurfacePoint<D>& point : std::span(points).subspan(before)) {
    point = {translation + rotation * point.at, rotation * point.normal};
  }
}

template <int D>
Volume Transformed<D>::volume() const
{
  return solid.volume();
}

template <int D>
void Transformed<D>::check() const
{
  require_rotation<D>(rotation);
  require_finite<D>(translation, "translation");
}

template struct Transformed<2>;
template struct Transformed<3>;

}  // namespace tamp::components
