#include "components/geometry/solid.hpp"

#include <algorithm>
#include <limits>

namespace tamp::components
{

namespace
{

/// Whether a point of a face of one of the solid's shapes is one of the whole's surface: neither covered by another
/// shape nor outside one that it would have to be in.
template <int D>
bool is_of_surface(const Solid<D>& solid, const Vector<D>& middle, const SurfacePoint<D>& point)
{
  const double little = 1e-9 * (point.at.norm() + (point.at - middle).norm());
  if (solid.contains(point.at + little * point.normal)) return false;
  // Rims and tips are not beneath the face alone; towards the middle lies the inside, too.
  const Vector<D> inward = (middle - point.at).normalized();
  return solid.contains(point.at - little * point.normal) || solid.contains(point.at + little * inward) ||
         solid.contains(point.at + little * (inward - point.normal));
}

/// The signed distance of `x`, given the nearest point of the surface.
template <int D>
SignedDistance<D> distance_from(const SurfacePoint<D>& nearest, const Vector<D>& x, bool is_inside)
{
  const Vector<D> away = x - nearest.at;
  const double length = away.norm(), along = away.dot(nearest.normal);
  // Straight above or beneath a face, or too near to tell.
  const bool is_straight = length * length - along * along <= 1e-12 * length * length || length <= 1e-10 * x.norm();
  if (is_straight) return {along, nearest.normal};
  return is_inside ? SignedDistance<D>{-length, -away / length} : SignedDistance<D>{length, away / length};
}

}  // namespace

template <int D>
SignedDistance<D> Solid<D>::distance(const Vector<D>& x) const
{
  const bool is_inside = contains(x);
  thread_local SurfacePoints<D> points;
  points.clear();
  faces(x, points);
  if (is_made_of_others_) {  // beyond a face is outside, beneath it inside
    const auto is_of_other_side = [&](const SurfacePoint<D>& point) {
      const double along = (x - point.at).dot(point.normal);
      return is_inside ? along > 0 : along < 0;
    };
    std::erase_if(points, is_of_other_side);
  }
  const auto is_nearer = [&](const SurfacePoint<D>& a, const SurfacePoint<D>& b) {
    return (a.at - x).squaredNorm() < (b.at - x).squaredNorm();
  };
  for (auto first = points.begin(); first != points.end(); ++first) {
    std::iter_swap(first, std::min_element(first, points.end(), is_nearer));
    if (!is_made_of_others_ || is_of_surface<D>(*this, middle_, *first)) {
      return distance_from<D>(*first, x, is_inside);
    }
  }
  // An edge in which two shapes meet is nearest: the nearest of their faces goes on beyond it.
  if (!points.empty()) return distance_from<D>(points.front(), x, is_inside);
  const double infinity = std::numeric_limits<double>::infinity();
  return {is_inside ? -infinity : infinity, Vector<D>::Unit(0)};
}

template class Solid<2>;
template class Solid<3>;

}  // namespace tamp::components
