#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "components/curves/octave_buckets.hpp"
#include "components/lanes.hpp"

namespace tamp::components
{

/// A curve y(x) through tabulated points: straight between them, and beyond both ends straight on along the end
/// segments. At a point the slope to its right counts (the last point: that to its left).
class PiecewiseLinear
{
 public:
  template <class Number>
  struct ValueOf {
    Number value;
    Number slope;
    Number from_kink;  ///< distance in x from an inner point nearby, positive to its right
  };
  using Value = ValueOf<double>;

  /// Throws BadValue, with the row, unless there are at least two points, all finite, with `x` strictly increasing.
  PiecewiseLinear(std::vector<double> x, std::vector<double> y);

  /// Constant time for points that are spread with some evenness, O(log n) for any.
  template <class Number>
  ValueOf<Number> at(const Number& x) const
  {
    const KinkOf<Number> kink = kink_near(x);
    const Number slope = select(x < kink.x, kink.left_slope, kink.right_slope), from_kink = x - kink.x;
    return {kink.y + slope * from_kink, slope, from_kink};
  }
  double operator()(double x) const { return at(x).value; }

  /// The slopes to the left and right of the inner point that `at` measures from.
  std::pair<double, double> slopes_beside_kink(double x) const;

  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  std::size_t n_segments() const { return slopes_.size(); }
  double slope_of_segment(std::size_t i) const { return slopes_[i]; }
  std::size_t segment_of(double x) const;

 private:
  /// An inner point. (Of a curve with one segment: its first point.)
  template <class Number>
  struct alignas(Number) alignas(4 * sizeof(double)) KinkOf {
    Number x, y, left_slope, right_slope;
  };
  using Kink = KinkOf<double>;

  void cut_into_buckets();

  /// An inner point that has no other between itself and x.
  const Kink& kink_near(double x) const { return kinks_[buckets_ ? buckets_->of(x) : last_kink_before(x)]; }
  KinkOf<Lanes> kink_near(const Lanes& x) const
  {
    std::array<const double*, n_lanes> near;
    if (buckets_) {
      const auto bucket = buckets_->of(x);
      for (std::size_t l = 0; l < n_lanes; ++l) near[l] = &kinks_[bucket[l]].x;
    } else {
      for (std::size_t l = 0; l < n_lanes; ++l) near[l] = &kinks_[last_kink_before(x[l])].x;
    }
    const auto [kink_x, kink_y, left_slope, right_slope] = side_by_side<4>(near);
    return {kink_x, kink_y, left_slope, right_slope};
  }
  std::size_t last_kink_before(double x) const;

  std::vector<double> x_, y_, slopes_;
  /// Buckets with at most one inner point in each; none where the points are too uneven for that.
  std::optional<OctaveBuckets> buckets_;
  /// The inner point of each bucket; without buckets all inner points.
  std::vector<Kink> kinks_;
};

/// Throws BadValue, with the row, unless the numbers are finite and each is greater than the one before.
void check_strictly_increasing(std::span<const double> values, const char* what);

}  // namespace tamp::components
