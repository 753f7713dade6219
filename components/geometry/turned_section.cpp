#include "components/geometry/turned_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

/// Radii between which the solid lies about the line x = z = 0 [m].
struct Radii {
  double least, greatest;

  explicit Radii(const Box<3>& box)
  {
    const auto nearest = [&](int k) { return std::max({0.0, box.lower[k], -box.upper[k]}); };
    const auto farthest = [&](int k) { return std::max(std::abs(box.lower[k]), std::abs(box.upper[k])); };
    least = portable::hypot(nearest(0), nearest(2));
    greatest = portable::hypot(farthest(0), farthest(2));
  }
};

/// Solids that are made of many others take longer to ask.
int n_points_for(const Solid<3>& solid)
{
  constexpr std::size_t most = 1 << 18, least = 1 << 12;
  return static_cast<int>(std::max(least, most / std::max<std::size_t>(1, solid.n_shapes())));
}

}  // namespace

TurnedVolumes volumes_of_turning(const Solid<3>& solid)
{
  // The additive recurrence by the powers of the root of t^4 = t + 1 fills [0, 1)^3 evenly.
  constexpr std::array<double, 3> strides{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  const Box<3> box = solid.bounding_box();
  const Radii radii(box);
  const double inner = radii.least * radii.least, outer = radii.greatest * radii.greatest;
  const double height = box.upper[1] - box.lower[1];
  const int n_points = n_points_for(solid);
  std::array<double, 3> place{0.5, 0.5, 0.5};
  int n_of_solid = 0, n_of_turned = 0, n_apart = 0;
  for (int i = 0; i < n_points; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      place[k] += strides[k];
      place[k] -= std::floor(place[k]);
    }
    const double radius = std::sqrt(inner + place[0] * (outer - inner)), y = box.lower[1] + place[1] * height;
    const double angle = 2 * std::numbers::pi * place[2];
    const bool is_in_solid = solid.contains({radius * portable::cos(angle), y, radius * portable::sin(angle)});
    const bool is_in_turned = solid.contains({radius, y, 0});
    if (is_in_solid) ++n_of_solid;
    if (is_in_turned) ++n_of_turned;
    if (is_in_solid != is_in_turned) ++n_apart;
  }
  const double volume_of_point = std::numbers::pi * (outer - inner) * std::max(0.0, height) / n_points;
  return {n_of_solid * volume_of_point, n_of_turned * volume_of_point, n_apart * volume_of_point};
}

}  // namespace tamp::components
