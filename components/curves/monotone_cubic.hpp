#pragma once

#include <span>
#include <vector>

namespace tamp::components
{

/// Slopes at the points of the cubic that rises and falls only where its points do (Fritsch and Butland 1984: weighted
/// harmonic means of the neighbouring chords; three-point formula, limited, at the ends). Two points make a straight.
std::vector<double> monotone_slopes(std::span<const double> x, std::span<const double> y);

/// Value and slope of the cubic on [0, h] with values y0, y1 and slopes m0, m1 at its ends, at distance `x` from the
/// first.
template <class Number>
struct CubicValueOf {
  Number value;
  Number slope;
};
using CubicValue = CubicValueOf<double>;
template <class Number>
CubicValueOf<Number> cubic(const Number& h, const Number& y0, const Number& m0, const Number& y1, const Number& m1,
                           const Number& x)
{
  const Number t = x / h;
  const Number chord = (y1 - y0) / h;
  const Number a = m0 + m1 - 2 * chord;
  const Number b = 3 * chord - 2 * m0 - m1;
  return {y0 + x * (m0 + t * (b + t * a)), m0 + t * (2 * b + 3 * t * a)};
}

/// The monotone cubic through points, straight beyond both ends.
class MonotoneCubic
{
 public:
  /// `x` strictly increasing, at least two points (checked by whoever reads the table).
  MonotoneCubic(std::vector<double> x, std::vector<double> y);

  CubicValue at(double x) const;

  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }

 private:
  std::vector<double> x_, y_, slope_;
};

}  // namespace tamp::components
