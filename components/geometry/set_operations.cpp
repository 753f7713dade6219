#include "components/geometry/set_operations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "components/errors.hpp"
#include "components/geometry/sampled_volume.hpp"

namespace tamp::components
{

namespace
{

template <int D>
bool any_holds(std::span<const Solid<D>> solids, const Vector<D>& x)
{
  return std::any_of(solids.begin(), solids.end(), [&](const Solid<D>& s) { return s.contains(x); });
}

template <int D>
bool all_hold(std::span<const Solid<D>> solids, const Vector<D>& x)
{
  return std::all_of(solids.begin(), solids.end(), [&](const Solid<D>& s) { return s.contains(x); });
}

template <int D>
Box<D> common_box(const Box<D>& a, const Box<D>& b)
{
  return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
}

/// The part of `solid` that the others overlap.
template <int D>
Volume shared_volume(const Solid<D>& solid, std::span<const Solid<D>> others)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Box<D> box = solid.bounding_box();
  Box<D> meeting{Vector<D>::Constant(infinity), Vector<D>::Constant(-infinity)};
  std::vector<Solid<D>> near;
  for (const Solid<D>& other : others) {
    const Box<D> common = common_box(box, other.bounding_box());
    if (!(common.lower.array() < common.upper.array()).all()) continue;
    near.push_back(other);
    meeting = {meeting.lower.cwiseMin(common.lower), meeting.upper.cwiseMax(common.upper)};
  }
  if (near.empty()) return {0};
  return sampled_volume<D>(meeting, [&](const Vector<D>& x) { return solid.contains(x) && any_holds<D>(near, x); });
}

Volume difference(const Volume& a, const Volume& b)
{
  return {a.value - b.value, a.error + b.error};
}

void require_parts(std::size_t n_parts)
{
  if (n_parts == 0) throw BadValue("no solids", "1 or more");
}

}  // namespace

template <int D>
bool Union<D>::contains(const Vector<D>& x) const
{
  return any_holds<D>(parts, x);
}

template <int D>
double Union<D>::reach(const Vector<D>& direction) const
{
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Solid<D>& part : parts) furthest = std::max(furthest, part.reach(direction));
  return furthest;
}

template <int D>
void Union<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  for (const Solid<D>& part : parts) part.faces(x, points);
}

template <int D>
Volume Union<D>::volume() const
{
  Volume sum{0};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Volume added =
        difference(parts[i].volume(), shared_volume<D>(parts[i], std::span<const Solid<D>>(parts).first(i)));
    sum = {sum.value + added.value, sum.error + added.error};
  }
  return sum;
}

template <int D>
void Union<D>::check() const
{
  require_parts(parts.size());
}

template <int D>
bool Intersection<D>::contains(const Vector<D>& x) const
{
  return all_hold<D>(parts, x);
}

template <int D>
double Intersection<D>::reach(const Vector<D>& direction) const
{
  double furthest = std::numeric_limits<double>::infinity();
  for (const Solid<D>& part : parts) furthest = std::min(furthest, part.reach(direction));
  return furthest;
}

template <int D>
void Intersection<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  for (const Solid<D>& part : parts) part.faces(x, points);
}

template <int D>
Volume Intersection<D>::volume() const
{
  if (parts.size() == 1) return parts.front().volume();
  Box<D> box = parts.front().bounding_box();
  for (const Solid<D>& part : parts) box = common_box(box, part.bounding_box());
  if (!(box.lower.array() < box.upper.array()).all()) return {0};
  return sampled_volume<D>(box, [&](const Vector<D>& x) { return all_hold<D>(parts, x); });
}

template <int D>
void Intersection<D>::check() const
{
  require_parts(parts.size());
}

template <int D>
bool Difference<D>::contains(const Vector<D>& x) const
{
  return whole.contains(x) && !any_holds<D>(without, x);
}

template <int D>
double Difference<D>::reach(const Vector<D>& direction) const
{
  return whole.reach(direction);
}

template <int D>
void Difference<D>::faces(const Vector<D>& x, SurfacePoints<D>& points) const
{
  whole.faces(x, points);
  const std::size_t before = points.size();
  for (const Solid<D>& hole : without) hole.faces(x, points);
  for (SurfacePoint<D>& point : std::span(points).subspan(before)) point.normal = -point.normal;
}

template <int D>
Volume Difference<D>::volume() const
{
  return difference(whole.volume(), shared_volume<D>(whole, without));
}

template struct Union<2>;
template struct Union<3>;
template struct Intersection<2>;
template struct Intersection<3>;
template struct Difference<2>;
template struct Difference<3>;

}  // namespace tamp::components
