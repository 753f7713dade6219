#pragma once

#include <array>

namespace tamp::components
{

/// A pressure surface at one point: pressure, its derivatives by elastic and by plastic strain, and by both.
template <class Number>
struct SurfaceNodeOf {
  Number pressure;
  Number bulk_modulus;
  Number coupling;
  Number modulus_by_plastic;

  /// This node in other units of strain: each derivative is multiplied with the units it is taken by.
  SurfaceNodeOf per(const Number& elastic, const Number& plastic) const
  {
    return {pressure, bulk_modulus * elastic, coupling * plastic, modulus_by_plastic * elastic * plastic};
  }

  bool operator==(const SurfaceNodeOf&) const = default;
};
using SurfaceNode = SurfaceNodeOf<double>;

/// The bicubic on the unit square that has given values, first derivatives and mixed derivatives at the corners
/// (Hermite's). Two patches that share the nodes of an edge join with continuous value and slope.
template <class Number>
struct HermitePatchOf {
  using Node = SurfaceNodeOf<Number>;

  std::array<Node, 4> corner;  ///< (0, 0), (1, 0), (0, 1), (1, 1); elastic strain first

  bool operator==(const HermitePatchOf&) const = default;

  Node at(const Number& elastic, const Number& plastic) const
  {
    const Weights value = Weights::of_value(plastic), slope = Weights::of_slope(plastic);
    const Node left = between(corner[0], corner[2], value, slope);
    const Node right = between(corner[1], corner[3], value, slope);
    const Weights v = Weights::of_value(elastic), s = Weights::of_slope(elastic);
    return {v(left.pressure, right.pressure, left.bulk_modulus, right.bulk_modulus),
            s(left.pressure, right.pressure, left.bulk_modulus, right.bulk_modulus),
            v(left.coupling, right.coupling, left.modulus_by_plastic, right.modulus_by_plastic),
            s(left.coupling, right.coupling, left.modulus_by_plastic, right.modulus_by_plastic)};
  }

 private:
  /// Weights of the values and slopes at the ends of the unit interval in the cubic between them, or in its slope.
  struct Weights {
    Number low, high, low_slope, high_slope;

    static Weights of_value(const Number& t)
    {
      const Number s = 1 - t, high = t * t * (3 - 2 * t);
      return {1 - high, high, t * s * s, -t * t * s};
    }
    static Weights of_slope(const Number& t)
    {
      const Number s = 1 - t, change = 6 * t * s;
      return {-change, change, s * (1 - 3 * t), t * (3 * t - 2)};
    }
    Number operator()(const Number& at_low, const Number& at_high, const Number& slope_at_low,
                      const Number& slope_at_high) const
    {
      return low * at_low + high * at_high + low_slope * slope_at_low + high_slope * slope_at_high;
    }
  };

  static Node between(const Node& a, const Node& b, const Weights& value, const Weights& slope)
  {
    return {value(a.pressure, b.pressure, a.coupling, b.coupling),
            value(a.bulk_modulus, b.bulk_modulus, a.modulus_by_plastic, b.modulus_by_plastic),
            slope(a.pressure, b.pressure, a.coupling, b.coupling),
            slope(a.bulk_modulus, b.bulk_modulus, a.modulus_by_plastic, b.modulus_by_plastic)};
  }
};

struct alignas(64) HermitePatch : HermitePatchOf<double> {
};

}  // namespace tamp::components
