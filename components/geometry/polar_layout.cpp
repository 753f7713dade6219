#include "components/geometry/polar_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

/// The part of a ring between two radii and two angles.
struct Sector {
  double inner, outer, from, to;

  double area() const { return 0.5 * (outer * outer - inner * inner) * (to - from); }
  /// Volume of the solid of revolution about the axis x = 0, the ring's centre being at x: 2 pi times the integral of x
  /// over it.
  double revolved(double x) const
  {
    const double cubes = outer * outer * outer - inner * inner * inner;
    return 2 * std::numbers::pi * (x * area() + cubes / 3 * (portable::sin(to) - portable::sin(from)));
  }
};

}  // namespace

std::vector<Site<2>> PolarLayout::sites(double spacing, bool revolved) const
{
  constexpr double pi = std::numbers::pi;
  const double depth = outer_radius - inner_radius;
  const int n_rings = std::max(1, static_cast<int>(std::lround(depth / spacing)));
  const double width = depth / n_rings;
  std::vector<Site<2>> all;
  for (int ring = 0; ring < n_rings; ++ring) {
    const double radius = inner_radius + (ring + 0.5) * width;
    const double wanted = 2 * pi * radius / width;
    const int n_sectors = part ? 4 * std::max(1, static_cast<int>(std::lround(wanted / 4)))
                               : std::max(3, static_cast<int>(std::lround(wanted)));
    for (int sector = 0; sector < n_sectors; ++sector) {
      const double angle = 2 * pi * (sector + 0.5) / n_sectors, half = pi / n_sectors;
      const Vector<2> place = centre + radius * Vector<2>(portable::cos(angle), portable::sin(angle));
      if (part && !part->contains(place)) continue;
      const Sector region{radius - 0.5 * width, radius + 0.5 * width, angle - half, angle + half};
      all.push_back({place, revolved ? region.revolved(centre[0]) : 2 * pi * radius * width / n_sectors});
    }
  }
  return all;
}

Matrix<2> PolarLayout::axes_at(const Vector<2>& place) const
{
  const Vector<2> outwards = (place - centre).normalized();
  Matrix<2> axes;
  axes << outwards[0], -outwards[1], outwards[1], outwards[0];
  return axes;
}

}  // namespace tamp::components
