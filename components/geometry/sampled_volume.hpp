#pragma once

#include <algorithm>
#include <cmath>

#include "components/geometry/box.hpp"
#include "components/geometry/volume.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

/// The integral of `value` over a box, from its mean at a fixed sequence of 2^20 points: the additive recurrence of the
/// D-dimensional golden ratio. The error stated is twice the standard error between 16 parts of the sequence, and no
/// less than the share of one point at which the value is 1.
template <int D, class Value>
Volume sampled_integral(const Box<D>& box, Value&& value)
{
  constexpr int n_parts = 16, n_points = 1 << 16;
  // The real root of t^(D+1) = t + 1.
  constexpr double golden = D == 2 ? 1.32471795724474602596 : 1.22074408460575947536;
  Vector<D> stride;
  for (int k = 0; k < D; ++k) stride[k] = portable::pow(golden, -(k + 1));

  const Vector<D> edges = box.upper - box.lower;
  Vector<D> place = Vector<D>::Constant(0.5);
  double sum = 0, sum_of_squares = 0;
  for (int part = 0; part < n_parts; ++part) {
    double total = 0;
    for (int point = 0; point < n_points; ++point) {
      place += stride;
      place.array() -= place.array().floor();
      total += value(Vector<D>(box.lower + place.cwiseProduct(edges)));
    }
    const double share = total / n_points;
    sum += share;
    sum_of_squares += share * share;
  }
  const double mean = sum / n_parts;
  const double variance = std::max(0.0, sum_of_squares / n_parts - mean * mean) / (n_parts - 1);
  const double least = 1.0 / (static_cast<double>(n_parts) * n_points);
  return {mean * edges.prod(), std::max(2 * std::sqrt(variance), least) * edges.prod()};
}

/// Volume of what `inside` says yes to within a box.
template <int D, class Inside>
Volume sampled_volume(const Box<D>& box, Inside&& inside)
{
  return sampled_integral<D>(box, [&inside](const Vector<D>& x) { return inside(x) ? 1.0 : 0.0; });
}

}  // namespace tamp::components
