#include "components/geometry/cone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "components/errors.hpp"
#include "components/geometry/axis.hpp"
#include "components/geometry/checks.hpp"

namespace tamp::components
{

namespace
{

void check_ends(const Vector<3>& first_end, const Vector<3>& second_end)
{
  require_finite<3>(first_end, "first end");
  require_finite<3>(second_end, "second end");
  require_positive((second_end - first_end).norm(), "length");
}

/// A point's place along the axis, 0 at the first end and 1 at the second, and its distance from it, squared.
AxialPoint between_ends(const Vector<3>& first_end, const Vector<3>& second_end, const Vector<3>& x)
{
  const Vector<3> axis = second_end - first_end;
  const Vector<3> from_end = x - first_end;
  const double along = from_end.dot(axis) / axis.squaredNorm();
  return {along, (from_end - along * axis).squaredNorm()};
}

}  // namespace

bool Cylinder::contains(const Vector<3>& x) const
{
  const AxialPoint p = between_ends(first_end, second_end, x);
  return p.along >= 0 && p.along < 1 && p.radius_squared < radius * radius;
}

double Cylinder::reach(const Vector<3>& direction) const
{
  return Cone{first_end, second_end, radius, radius}.reach(direction);
}

void Cylinder::faces(const Vector<3>& x, SurfacePoints<3>& points) const
{
  Cone{first_end, second_end, radius, radius}.faces(x, points);
}

Volume Cylinder::volume() const
{
  return {std::numbers::pi * radius * radius * (second_end - first_end).norm()};
}

void Cylinder::check() const
{
  check_ends(first_end, second_end);
  require_positive(radius, "radius");
}

bool Cone::contains(const Vector<3>& x) const
{
  const AxialPoint p = between_ends(first_end, second_end, x);
  const double radius = first_radius + p.along * (second_radius - first_radius);
  return p.along >= 0 && p.along < 1 && p.radius_squared < radius * radius;
}

double Cone::reach(const Vector<3>& direction) const
{
  const Vector<3> axis = second_end - first_end;
  const Axis line{first_end, axis.normalized()};
  return std::max(line.rim_reach(0, first_radius, direction), line.rim_reach(axis.norm(), second_radius, direction));
}

void Cone::faces(const Vector<3>& x, SurfacePoints<3>& points) const
{
  const Vector<3> axis = second_end - first_end;
  const MeridianPlane plane = Axis{first_end, axis.normalized()}.plane_of(x);
  const Vector<2> first(0, first_radius), second(axis.norm(), second_radius);
  const auto add = [&](const Vector<2>& from, const Vector<2>& to) {
    points.push_back(plane.in_space(nearest_of_edge(from, to, plane.place)));
  };
  add(second, first);
  if (first_radius > 0) add(first, {0, 0});
  if (second_radius > 0) add({second[0], 0}, second);
}

Volume Cone::volume() const
{
  const double sum = first_radius * first_radius + first_radius * second_radius + second_radius * second_radius;
  return {std::numbers::pi / 3 * sum * (second_end - first_end).norm()};
}

void Cone::check() const
{
  check_ends(first_end, second_end);
  const double least = std::min(first_radius, second_radius), greatest = std::max(first_radius, second_radius);
  if (!(least >= 0) || !(greatest > 0) || !std::isfinite(greatest)) {
    throw BadValue("radii " + std::to_string(first_radius) + " and " + std::to_string(second_radius),
                   "finite radii of 0 or above, and not both 0");
  }
}

}  // namespace tamp::components
