#include "components/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "components/errors.hpp"
#include "components/geometry/checks.hpp"

namespace tamp::components
{

namespace
{

struct Edge {
  Vector<2> from;
  Vector<2> to;
};

double cross(const Vector<2>& a, const Vector<2>& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// The side of an edge on which `x` lies: above 0 on its left.
double side(const Edge& edge, const Vector<2>& x)
{
  return cross(edge.to - edge.from, x - edge.from);
}

bool is_on(const Edge& edge, const Vector<2>& x)
{
  return side(edge, x) == 0 && (x - edge.from).dot(x - edge.to) <= 0;
}

bool meet(const Edge& a, const Edge& b)
{
  const bool b_straddles = side(a, b.from) * side(a, b.to) < 0, a_straddles = side(b, a.from) * side(b, a.to) < 0;
  return (a_straddles && b_straddles) || is_on(a, b.from) || is_on(a, b.to) || is_on(b, a.from) || is_on(b, a.to);
}

/// Twice the area of a polygon whose corners run anticlockwise; minus that for others. Measured from the first corner,
/// so that a small polygon far from the origin loses no digits.
double twice_the_area(const std::vector<Vector<2>>& corners)
{
  double twice = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    twice += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return twice;
}

/// Do edges that follow one another run back over each other?
bool fold_back(const Edge& a, const Edge& b)
{
  return side(a, b.to) == 0 && (a.to - a.from).dot(b.to - b.from) < 0;
}

}  // namespace

Polygon::Polygon(std::vector<Vector<2>> corners)
    : corners_(std::move(corners)), is_counterclockwise_(twice_the_area(corners_) > 0)
{
  const std::size_t n = corners_.size();
  if (n < 3) throw BadValue("a polygon of " + std::to_string(n) + " corners", "3 or more");
  const auto edge = [&](std::size_t i) { return Edge{corners_[i], corners_[(i + 1) % n]}; };
  for (std::size_t i = 0; i < n; ++i) {
    require_finite<2>(corners_[i], "corner");
    const auto row = static_cast<std::ptrdiff_t>(i);
    if (edge(i).from == edge(i).to) throw BadValue("corner " + text<2>(corners_[i]) + " twice", "another corner", row);
    for (std::size_t j = 0; j < i; ++j) {
      const bool follows = i == j + 1, precedes = (i + 1) % n == j;
      const bool bad = follows    ? fold_back(edge(j), edge(i))
                       : precedes ? fold_back(edge(i), edge(j))
                                  : meet(edge(i), edge(j));
      if (!bad) continue;
      throw BadValue("the edge from " + text<2>(edge(i).from) + " to " + text<2>(edge(i).to) + " meets that from " +
                         text<2>(edge(j).from) + " to " + text<2>(edge(j).to),
                     "a polygon that does not cross itself", row);
    }
  }
}

bool Polygon::contains(const Vector<2>& x) const
{
  // Is the number of edges to the left of x odd?
  bool inside = false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    // Computed from the lower end, so that polygons that share an edge compute the same.
    const auto& [a, b] = std::minmax(corners_[i], corners_[(i + 1) % corners_.size()],
                                     [](const Vector<2>& p, const Vector<2>& q) { return p[1] < q[1]; });
    if (a[1] > x[1] || b[1] <= x[1]) continue;
    if (x[0] >= a[0] + (x[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])) inside = !inside;
  }
  return inside;
}

double Polygon::reach(const Vector<2>& direction) const
{
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Vector<2>& corner : corners_) furthest = std::max(furthest, corner.dot(direction));
  return furthest;
}

void Polygon::faces(const Vector<2>& x, SurfacePoints<2>& points) const
{
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector<2>&from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
    points.push_back(is_counterclockwise_ ? nearest_of_edge(from, to, x) : nearest_of_edge(to, from, x));
  }
}

Volume Polygon::volume() const
{
  return {std::abs(twice_the_area(corners_)) / 2};
}

bool ExtrudedPolygon::contains(const Vector<3>& x) const
{
  return lower <= x[2] && x[2] < upper && base.contains(x.head<2>());
}

double ExtrudedPolygon::reach(const Vector<3>& direction) const
{
  return base.reach(direction.head<2>()) + std::max(lower * direction[2], upper * direction[2]);
}

void ExtrudedPolygon::faces(const Vector<3>& x, SurfacePoints<3>& points) const
{
  thread_local SurfacePoints<2> sides;
  sides.clear();
  base.faces(x.head<2>(), sides);
  const double z = std::clamp(x[2], lower, upper);
  for (const SurfacePoint<2>& side : sides) {
    points.push_back({{side.at[0], side.at[1], z}, {side.normal[0], side.normal[1], 0}});
  }
  // On both ends, the nearest place is the one beneath the point, or the nearest on their rims.
  const auto nearest = std::min_element(sides.begin(), sides.end(), [&](const auto& a, const auto& b) {
    return (a.at - x.head<2>()).squaredNorm() < (b.at - x.head<2>()).squaredNorm();
  });
  const Vector<2> place = base.contains(x.head<2>()) ? Vector<2>(x.head<2>()) : nearest->at;
  points.push_back({{place[0], place[1], lower}, -Vector<3>::Unit(2)});
  points.push_back({{place[0], place[1], upper}, Vector<3>::Unit(2)});
}

Volume ExtrudedPolygon::volume() const
{
  return {base.volume().value * (upper - lower)};
}

void ExtrudedPolygon::check() const
{
  require_positive(upper - lower, "height");
}

}  // namespace tamp::components
