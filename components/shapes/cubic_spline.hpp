#pragma once

#include <array>
#include <string_view>

#include "components/lanes.hpp"
#include "components/shapes/product_shape.hpp"

namespace tamp::components
{

/// Cubic B-splines at the particle's place (Steffen, Kirby & Berzins, Int. J. Numer. Meth. Eng. 76, 2008): 4 nodes an
/// axis, with continuous second derivatives. Beside a wall the mirror image completes them.
template <int D>
class CubicSpline : public ProductShape<CubicSpline<D>, D, 4>
{
 public:
  static constexpr std::string_view word = "cubic_spline";
  static constexpr std::string_view meaning = "cubic B-splines";
  static constexpr bool deforms = false;
  static constexpr bool is_spline = true;

  explicit CubicSpline(int /*n_per_axis*/) {}

  /// See components::greatest_own_stiffness; 3.137 at 0.27 cells beyond a node is the greatest.
  double greatest_stiffness_along_axis() const { return 3.14; }

  template <class Number>
  Number along(const Number& place, const Number& cell, const Number& /*stretch*/, double per_cell,
               std::array<Number, 4>& w, std::array<Number, 4>& s) const
  {
    const Number t = place - cell, u = 1.0 - t;
    w[0] = u * u * u / 6.0;
    w[3] = t * t * t / 6.0;
    w[1] = 2.0 / 3.0 - t * t * (1.0 - 0.5 * t);
    w[2] = 1.0 - w[0] - w[1] - w[3];
    s[0] = -0.5 * u * u * per_cell;
    s[3] = 0.5 * t * t * per_cell;
    s[1] = -t * (2.0 - 1.5 * t) * per_cell;
    s[2] = -s[0] - s[1] - s[3];
    return cell - 1.0;
  }
};

}  // namespace tamp::components
