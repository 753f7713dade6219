#include "components/materials/yield_surface.hpp"

#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

namespace
{

/// The upper hull, by Andrew's monotone chain.
PiecewiseLinear concave_envelope(std::span<const double> x, std::span<const double> y)
{
  if (x.size() != y.size()) {
    throw BadValue(std::to_string(x.size()) + " pressures and " + std::to_string(y.size()) + " strengths",
                   "as many of one as of the other");
  }
  if (x.size() < 2) throw BadValue(std::to_string(x.size()) + " points of yield", "at least two");
  check_strictly_increasing(x, "pressure");
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(y[i]) || y[i] < 0 || (i == 0 && y[i] > 0)) {
      throw BadValue("sqrt(J2) " + std::to_string(y[i]), i == 0 ? "0, the tension vertex" : "a number not negative",
                     static_cast<std::ptrdiff_t>(i));
    }
  }

  std::vector<double> hull_x, hull_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    while (hull_x.size() >= 2) {
      const std::size_t n = hull_x.size();
      const double before = (hull_y[n - 1] - hull_y[n - 2]) * (x[i] - hull_x[n - 1]);
      const double after = (y[i] - hull_y[n - 1]) * (hull_x[n - 1] - hull_x[n - 2]);
      if (after < before) break;
      hull_x.pop_back();
      hull_y.pop_back();
    }
    hull_x.push_back(x[i]);
    hull_y.push_back(y[i]);
  }
  const std::size_t n = hull_x.size();
  if (hull_y[n - 1] < hull_y[n - 2] || hull_y[1] == 0) {
    throw BadValue("a strength of " + std::to_string(hull_y[n - 1]) + " at the greatest pressure",
                   "strength that grows with pressure", static_cast<std::ptrdiff_t>(x.size()) - 1);
  }
  return PiecewiseLinear(std::move(hull_x), std::move(hull_y));
}

}  // namespace

YieldSurface::YieldSurface(std::span<const double> pressure, std::span<const double> sqrt_j2, double cap_ellipticity)
    : hull_(concave_envelope(pressure, sqrt_j2)), vertex_pressure_(pressure.front()), cap_ellipticity_(cap_ellipticity)
{
  if (!(cap_ellipticity > 0 && cap_ellipticity < 1)) {
    throw BadValue("cap ellipticity " + std::to_string(cap_ellipticity), "a number between 0 and 1");
  }
  if (!(vertex_pressure_ <= 0)) {
    throw BadValue("a tension vertex at pressure " + std::to_string(vertex_pressure_), "one at 0 or in tension", 0);
  }
}

}  // namespace tamp::components
