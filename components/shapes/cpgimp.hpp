#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "components/lanes.hpp"
#include "components/shapes/product_shape.hpp"

namespace tamp::components
{

/// Generalised interpolation whose particles are as long along the axes as they are deformed (Wallstedt & Guilkey, J.
/// Comput. Phys. 227, 2008): contiguous particles stay contiguous where F is diagonal, so that neither gaps nor
/// overlaps spoil the sums over particles. Linear functions are averaged over a box with the particle's second moments,
/// which a rotation leaves alone. 4 nodes an axis: half the box is at most a cell, and more than that counts as a cell.
template <int D>
class Cpgimp : public ProductShape<Cpgimp<D>, D, 4>
{
 public:
  static constexpr std::string_view word = "cpgimp";
  static constexpr std::string_view meaning = "their means over particles of a size that follows the deformation";
  static constexpr bool deforms = true;

  /// `n_per_axis` particles along each axis of a cell, each as large as its share at first; at least 1.
  explicit Cpgimp(int n_per_axis) : half_size_(0.5 / n_per_axis) {}

  /// See components::greatest_own_stiffness: of a particle that is not deformed.
  double greatest_stiffness_along_axis() const { return 2 / half_size_ + 1 / (1 - half_size_); }

  template <class Number>
  Number along(const Number& place, const Number& cell, const Number& stretch, double per_cell,
               std::array<Number, 4>& w, std::array<Number, 4>& s) const
  {
    const Number l = lesser_of<Number>(half_size_ * stretch, 1.0);
    const Number first = cell - 1.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Number away = place - first - static_cast<double>(i), distance = abs(away);
      w[i] = (area_beyond(distance - l) - area_beyond(distance + l)) / (2.0 * l);
      s[i] = (hat(away + l) - hat(away - l)) / (2.0 * l) * per_cell;
    }
    return first;
  }

 private:
  /// The hat of a node at 0.
  template <class Number>
  static Number hat(const Number& x)
  {
    return greater_of<Number>(1.0 - abs(x), 0.0);
  }
  /// Beneath the hat, beyond x, at least -1: without cancellation where a particle hardly reaches the node.
  template <class Number>
  static Number area_beyond(const Number& x)
  {
    const Number half_square = 0.5 * hat(x) * hat(x);
    return select(x < 0.0, 1.0 - half_square, half_square);
  }

  /// Half of a particle's size at the start [cells].
  double half_size_;
};

}  // namespace tamp::components
