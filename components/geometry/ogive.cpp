#include "components/geometry/ogive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "components/errors.hpp"
#include "components/geometry/axis.hpp"
#include "components/geometry/checks.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

// With x back from the base, r(x) = sqrt(rho^2 - x^2) - (rho - R): an arc of radius rho about a point at the base, at
// rho - R beyond the axis.

bool Ogive::contains(const Vector<3>& x) const
{
  const double back = length(), rho = arc();
  const AxialPoint p = Axis{base, (tip - base) / back}.of(x);
  if (p.along <= 0 || p.along >= back) return false;
  const double r = std::sqrt(rho * rho - p.along * p.along) - (rho - radius);
  return r > 0 && p.radius_squared < r * r;
}

double Ogive::reach(const Vector<3>& direction) const
{
  const double back = length(), rho = arc();
  const Axis axis{base, (tip - base) / back};
  const double forward = axis.direction.dot(direction);
  const double outward = (direction - forward * axis.direction).norm();
  double furthest = std::max(axis.rim_reach(0, radius, direction), axis.rim_reach(back, 0, direction));
  // The arc's own point whose normal is the direction, where there is one.
  const double x = rho * forward / portable::hypot(forward, outward);
  if (x > 0 && x < back) {
    const double r = std::sqrt(rho * rho - x * x) - (rho - radius);
    furthest = std::max(furthest, axis.rim_reach(x, r, direction));
  }
  return furthest;
}

void Ogive::faces(const Vector<3>& x, SurfacePoints<3>& points) const
{
  const double back = length(), rho = arc();
  const MeridianPlane plane = Axis{base, (tip - base) / back}.plane_of(x);
  const Vector<2> centre(0, radius - rho), rim(0, radius), end(back, 0);
  const Vector<2> from_centre = plane.place - centre, to_end = end - centre;
  const bool is_beside = from_centre[0] >= 0 && to_end[0] * from_centre[1] - to_end[1] * from_centre[0] >= 0;
  const bool is_nearer_rim = (plane.place - rim).squaredNorm() < (plane.place - end).squaredNorm();
  const Vector<2> direction = is_beside && from_centre.norm() > 0 ? from_centre : is_nearer_rim ? rim - centre : to_end;
  const Vector<2> normal = direction.normalized();
  points.push_back(plane.in_space({centre + rho * normal, normal}));
  points.push_back(plane.in_space(nearest_of_edge(rim, {0, 0}, plane.place)));
}

Volume Ogive::volume() const
{
  const double back = length(), rho = arc(), shift = rho - radius;
  const double r_squared = rho * rho * back - back * back * back / 3 + shift * shift * back;
  const double segment = 0.5 * (back * shift + rho * rho * portable::asin(std::min(1.0, back / rho)));
  return {std::numbers::pi * (r_squared - 2 * shift * segment)};
}

void Ogive::check() const
{
  require_finite<3>(tip, "tip");
  require_finite<3>(base, "base");
  require_positive(length(), "length");
  require_positive(radius, "radius");
  if (radius > length() * (1 + 1e-12)) {
    throw BadValue("radius " + std::to_string(radius), "at most the ogive's length, " + std::to_string(length()));
  }
}

}  // namespace tamp::components
