#include "components/geometry/polar_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/portable_math.hpp"

namespace tamp::components
{

std::vector<Site<2>> PolarLayout::sites(double spacing) const
{
  constexpr double pi = std::numbers::pi;
  const double depth = outer_radius - inner_radius;
  const int n_rings = std::max(1, static_cast<int>(std::lround(depth / spacing)));
  const double width = depth / n_rings;
  std::vector<Site<2>> all;
  for (int ring = 0; ring < n_rings; ++ring) {
    const double radius = inner_radius + (ring + 0.5) * width;
    const int n_sectors = std::max(3, static_cast<int>(std::lround(2 * pi * radius / width)));
    for (int sector = 0; sector < n_sectors; ++sector) {
      const double angle = 2 * pi * (sector + 0.5) / n_sectors;
      const Vector<2> arm(radius * portable::cos(angle), radius * portable::sin(angle));
      all.push_back({centre + arm, 2 * pi * radius * width / n_sectors});
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
