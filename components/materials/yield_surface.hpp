#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "components/curves/piecewise_linear.hpp"

namespace tamp::components
{

/// The tabulated yield surface with an elliptic cap, sqrt(J2) = h(p, X) = g(p) Fc(p, X). Pressures are compression
/// positive; everything is in Pa.
///
///  - g is the concave envelope of the table (the upper hull of its points), zero below the first point, the tension
///    vertex, and straight on beyond the last.
///  - Fc closes it at the crush pressure X: with kappa = p_min + R (X - p_min) and rho = (p - kappa) / (X - kappa),
///    Fc = sqrt(1 - rho^2) above kappa and 1 below. At p = X the surface ends with an upright tangent (the apex).
class YieldSurface
{
 public:
  /// The columns of yield.csv: the first row is the tension vertex (sqrt_j2 = 0); `cap_ellipticity` is R, in (0, 1).
  /// Throws BadValue, with the row where there is one.
  YieldSurface(std::span<const double> pressure, std::span<const double> sqrt_j2, double cap_ellipticity);

  /// g and its slope; `segment` is that of the hull, empty below the vertex.
  struct Strength {
    double value;
    double slope;
    std::optional<std::size_t> segment;
  };
  Strength strength(double pressure) const
  {
    if (pressure < vertex_pressure_) return {0, hull_.slope_of_segment(0), std::nullopt};
    const PiecewiseLinear::Value g = hull_.at(pressure);
    return {g.value, g.slope, g.segment};
  }

  /// The slopes to the left and right of a kink of g, where the pressure is at one but for round-off.
  std::optional<std::pair<double, double>> slopes_at_kink(double pressure) const
  {
    const double width = 1e-7 * std::abs(pressure);
    const std::size_t left = hull_.at(pressure - width).segment, right = hull_.at(pressure + width).segment;
    if (left == right) return std::nullopt;
    return std::pair{hull_.slope_of_segment(left), hull_.slope_of_segment(right)};
  }

  /// The cap of one crush pressure. `sine` is Fc, 1 on the cone, 0 at and beyond the apex; `rho` is 0 on the cone.
  struct Cap {
    double kappa;
    double half_axis;  ///< X - kappa
    double rho;
    double sine;
  };
  Cap cap(double pressure, double crush_pressure) const
  {
    const double kappa = vertex_pressure_ + cap_ellipticity_ * (crush_pressure - vertex_pressure_);
    const double half_axis = crush_pressure - kappa;
    const double rho = std::max((pressure - kappa) / half_axis, 0.0);
    return {kappa, half_axis, rho, rho < 1 ? std::sqrt((1 - rho) * (1 + rho)) : 0.0};
  }

  /// h(p, X); zero outside [p_min, X].
  double limit(double pressure, double crush_pressure) const
  {
    return strength(pressure).value * cap(pressure, crush_pressure).sine;
  }

  double vertex_pressure() const { return vertex_pressure_; }
  double vertex_slope() const { return hull_.slope_of_segment(0); }
  double cap_ellipticity() const { return cap_ellipticity_; }
  const PiecewiseLinear& hull() const { return hull_; }

 private:
  PiecewiseLinear hull_;
  double vertex_pressure_;
  double cap_ellipticity_;
};

/// h_p times the sine, from g, its slope and the cap: g' sin^2 - g rho / (X - kappa), bounded everywhere. At the apex
/// and beyond it has its value at the apex.
inline double cap_slope_sine(double strength, double slope, const YieldSurface::Cap& cap)
{
  return slope * cap.sine * cap.sine - strength * std::min(cap.rho, 1.0) / cap.half_axis;
}

}  // namespace tamp::components
