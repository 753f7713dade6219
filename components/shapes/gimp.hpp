#pragma once

#include <array>
#include <string_view>

#include "components/lanes.hpp"
#include "components/shapes/product_shape.hpp"

namespace tamp::components
{

/// Generalised interpolation of particles of constant size: linear functions averaged over the particle's box
/// (Bardenhagen & Kober 2004; PAR-10021867-092020-6, eq. 22 and 44). 3 nodes an axis: 9 in the plane, 27 in space.
template <int D>
class Gimp : public ProductShape<Gimp<D>, D, 3>
{
 public:
  static constexpr std::string_view word = "gimp";
  static constexpr std::string_view meaning = "their means over particles of constant size";
  static constexpr bool deforms = false;

  /// `n_per_axis` particles along each axis of a cell, each as large as its share; at least 1.
  explicit Gimp(int n_per_axis) : Gimp(0.5 / n_per_axis, {}) {}
  /// Averaged over the size of a cell, however small the particles, linear functions are the quadratic B-spline
  /// (Steffen, Kirby & Berzins, Int. J. Numer. Meth. Eng. 76, 2008).
  static Gimp quadratic_spline() { return Gimp(0.5, {}); }

  /// Half the edge of the box averaged over, in cells.
  double half_size() const { return half_size_; }
  double reach() const { return 1 + half_size_; }
  /// See components::greatest_own_stiffness: the particle just reaches the node behind.
  double greatest_stiffness_along_axis() const { return 2 / half_size_ + 1 / (1 - half_size_); }

  template <class Number>
  Number along(const Number& place, const Number& /*cell*/, const Number& /*stretch*/, double per_cell,
               std::array<Number, 3>& w, std::array<Number, 3>& s) const
  {
    const double l = half_size_;
    const Number node = floor(place - l);
    // t in [l, 1 + l) from the first node. Up to 1 - l the particle lies within one cell and the functions are
    // linear; beyond, it straddles the second node, by e in [-l, l).
    const Number t = place - node;
    const Number e = greater_of<Number>(t - 1.0, -l);
    const Number within = greater_of<Number>(1 - l - t, 0.0);
    w[0] = (l - e) * (l - e) / (4 * l) + within;
    w[2] = (l + e) * (l + e) / (4 * l);
    w[1] = 1.0 - w[0] - w[2];
    s[0] = -(l - e) / (2 * l) * per_cell;
    s[2] = (l + e) / (2 * l) * per_cell;
    s[1] = -s[0] - s[2];
    return node;
  }

 private:
  struct OfHalfSize {
  };
  Gimp(double half_size, OfHalfSize) : half_size_(half_size) {}

  double half_size_;
};

/// Quadratic B-splines, whatever the size of particles.
template <int D>
class QuadraticSpline : public Gimp<D>
{
 public:
  static constexpr std::string_view word = "quadratic_spline";
  static constexpr std::string_view meaning = "quadratic B-splines";
  static constexpr bool is_spline = true;

  explicit QuadraticSpline(int /*n_per_axis*/) : Gimp<D>(Gimp<D>::quadratic_spline()) {}
};

}  // namespace tamp::components
