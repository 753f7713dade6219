#pragma once

#include <algorithm>
#include <cmath>
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

  /// g and its slope.
  template <class Number>
  PiecewiseLinear::ValueOf<Number> strength(const Number& pressure) const
  {
    PiecewiseLinear::ValueOf<Number> g = hull_.at(pressure);
    g.value = select(pressure < vertex_pressure_, Number(0.0), g.value);
    return g;
  }

  /// Whether the pressure whose strength was asked is at a kink of g, but for round-off.
  template <class Number>
  Mask<Number> is_kink(const Number& pressure, const PiecewiseLinear::ValueOf<Number>& strength) const
  {
    constexpr double width = 1e-7;
    return abs(strength.from_kink) <= width * abs(pressure);
  }

  /// The pressure at which the cap begins.
  template <class Number>
  Number kappa(const Number& crush_pressure) const
  {
    return vertex_pressure_ + cap_ellipticity_ * (crush_pressure - vertex_pressure_);
  }

  /// The cap of one crush pressure. `sine` is Fc, 1 on the cone, 0 at and beyond the apex; `rho` is 0 on the cone.
  template <class Number>
  struct CapOf {
    Number kappa;
    Number half_axis;  ///< X - kappa
    Number rho;
    Number sine;
  };
  using Cap = CapOf<double>;
  template <class Number>
  CapOf<Number> cap(const Number& pressure, const Number& crush_pressure) const
  {
    const Number start = kappa(crush_pressure), half_axis = crush_pressure - start;
    const Number rho = greater_of<Number>((pressure - start) / half_axis, 0.0);
    return {start, half_axis, rho, select(rho < 1.0, sqrt((1.0 - rho) * (1.0 + rho)), Number(0.0))};
  }

  /// h(p, X); zero outside [p_min, X].
  template <class Number>
  Number limit(const Number& pressure, const Number& crush_pressure) const
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
template <class Number>
Number cap_slope_sine(const Number& strength, const Number& slope, const YieldSurface::CapOf<Number>& cap)
{
  return slope * cap.sine * cap.sine - strength * lesser_of<Number>(cap.rho, 1.0) / cap.half_axis;
}

}  // namespace tamp::components
