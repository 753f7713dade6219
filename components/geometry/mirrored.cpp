#include "components/geometry/mirrored.hpp"

#include <algorithm>
#include <cmath>

namespace tamp::components
{

template <int D>
Vector<D> Mirrored<D>::image(const Vector<D>& x) const
{
  Vector<D> image = x;
  image[axis] = 2 * plane - x[axis];
  return image;
}

template <int D>
bool Mirrored<D>::contains(const Vector<D>& x) const
{
  return half.contains(is_beyond(x) ? image(x) : x);
}

template <int D>
double Mirrored<D>::reach(const Vector<D>& direction) const
{
  Vector<D> other = direction;
  other[axis] = -direction[axis];
  return std::max(half.reach(direction), half.reach(other) + 2 * plane * direction[axis]);
}

template <int D>
void Mirrored<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  const bool is_image = is_beyond(x);
  const std::size_t before = points.size();
  half.faces(is_image ? image(x) : x, points);
  const auto is_on_plane = [&](const SurfacePoint<D>& point) {
    const double near = 1e-9 * (point.at.norm() + std::abs(plane));
    return outside * point.normal[axis] > 1 - 1e-9 && std::abs(point.at[axis] - plane) <= near;
  };
  const auto first = points.begin() + static_cast<std::ptrdiff_t>(before);
  points.erase(std::remove_if(first, points.end(), is_on_plane), points.end());
  if (!is_image) return;
  for (std::size_t i = before; i < points.size(); ++i) {
    points[i].at = image(points[i].at);
    points[i].normal[axis] *= -1;
  }
}

template <int D>
Volume Mirrored<D>::volume() const
{
  const Volume of_half = half.volume();
  return {2 * of_half.value, 2 * of_half.error};
}

template struct Mirrored<2>;
template struct Mirrored<3>;

}  // namespace tamp::components
