#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tamp::components
{

/// A curve y(x) through tabulated points: straight between them, and beyond both ends straight on along the end
/// segments. At a point the segment to its right counts (the last point: the last segment).
class PiecewiseLinear
{
 public:
  struct Value {
    double value;
    double slope;
    std::size_t segment;
  };

  /// Throws BadValue, with the row, unless there are at least two points, all finite, with `x` strictly increasing.
  PiecewiseLinear(std::vector<double> x, std::vector<double> y);

  /// Value, slope and segment; constant time for evenly spread points, O(log n) for any.
  Value at(double x) const
  {
    const std::size_t i = segment_of(x);
    const Segment& s = segments_[i];
    return {s.y + s.slope * (x - s.x), s.slope, i};
  }

  double operator()(double x) const { return at(x).value; }

  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  std::size_t n_segments() const { return segments_.size(); }
  double slope_of_segment(std::size_t i) const { return segments_[i].slope; }

 private:
  struct Segment {
    double x, y, slope;
  };

  /// The segments that may hold an x in one of the equal intervals into which the range of x is cut.
  struct Bucket {
    std::uint32_t first, last;
  };

  std::size_t segment_of(double x) const
  {
    const double scaled = (x - x_.front()) * buckets_per_x_;
    // Written so that a NaN falls in the first bucket.
    const std::size_t bucket = !(scaled > 0)           ? 0
                               : scaled < last_bucket_ ? static_cast<std::size_t>(scaled)
                                                       : static_cast<std::size_t>(last_bucket_);
    std::size_t low = buckets_[bucket].first;
    std::size_t high = buckets_[bucket].last;
    while (high - low > 4) {
      const std::size_t middle = low + (high - low) / 2;
      (segments_[middle].x <= x ? low : high) = middle;
    }
    while (low < high && segments_[low + 1].x <= x) ++low;
    return low;
  }

  std::vector<double> x_, y_;
  std::vector<Segment> segments_;
  std::vector<Bucket> buckets_;
  double buckets_per_x_ = 0;
  double last_bucket_ = 0;
};

/// Throws BadValue, with the row, unless the numbers are finite and each is greater than the one before.
void check_strictly_increasing(std::span<const double> values, const char* what);

}  // namespace tamp::components
