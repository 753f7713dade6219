#include "components/curves/monotone_cubic.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tamp::components
{

namespace
{

/// Slope at an end point from the two chords next to it, limited so that the cubic stays monotone.
double end_slope(double h0, double h1, double chord0, double chord1)
{
  const double slope = ((2 * h0 + h1) * chord0 - h0 * chord1) / (h0 + h1);
  if (slope * chord0 <= 0) return 0;
  if (chord0 * chord1 <= 0 && std::abs(slope) > 3 * std::abs(chord0)) return 3 * chord0;
  return slope;
}

}  // namespace

std::vector<double> monotone_slopes(std::span<const double> x, std::span<const double> y)
{
  const std::size_t n = x.size();
  const auto width = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  if (n == 2) return {chord(0), chord(0)};

  std::vector<double> slopes(n);
  slopes.front() = end_slope(width(0), width(1), chord(0), chord(1));
  slopes.back() = end_slope(width(n - 2), width(n - 3), chord(n - 2), chord(n - 3));
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = chord(i - 1), after = chord(i);
    if (before * after <= 0) continue;
    const double weight_before = width(i - 1) + 2 * width(i), weight_after = 2 * width(i - 1) + width(i);
    slopes[i] = (weight_before + weight_after) / (weight_before / before + weight_after / after);
  }
  return slopes;
}

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(monotone_slopes(x_, y_))
{
}

CubicValue MonotoneCubic::at(double x) const
{
  if (x <= x_.front()) return {y_.front() + slope_.front() * (x - x_.front()), slope_.front()};
  if (x >= x_.back()) return {y_.back() + slope_.back() * (x - x_.back()), slope_.back()};
  const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
  return cubic(x_[i + 1] - x_[i], y_[i], slope_[i], y_[i + 1], slope_[i + 1], x - x_[i]);
}

}  // namespace tamp::components
