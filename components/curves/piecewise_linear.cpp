#include "components/curves/piecewise_linear.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

void check_strictly_increasing(std::span<const double> values, const char* what)
{
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto row = static_cast<std::ptrdiff_t>(i);
    if (!std::isfinite(values[i])) {
      throw BadValue(std::string(what) + " " + std::to_string(values[i]), "a finite number", row);
    }
    if (i > 0 && values[i] <= values[i - 1]) {
      throw BadValue(std::string(what) + " " + std::to_string(values[i]) + " after " + std::to_string(values[i - 1]),
                     "values that strictly increase", row);
    }
  }
}

PiecewiseLinear::PiecewiseLinear(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y))
{
  if (x_.size() != y_.size()) {
    throw BadValue(std::to_string(x_.size()) + " abscissae and " + std::to_string(y_.size()) + " ordinates",
                   "as many of one as of the other");
  }
  if (x_.size() < 2) throw BadValue(std::to_string(x_.size()) + " points", "at least two points");
  check_strictly_increasing(x_, "abscissa");
  for (std::size_t i = 0; i < y_.size(); ++i) {
    if (!std::isfinite(y_[i])) {
      throw BadValue("ordinate " + std::to_string(y_[i]), "a finite number", static_cast<std::ptrdiff_t>(i));
    }
  }

  for (std::size_t i = 0; i + 1 < x_.size(); ++i) slopes_.push_back((y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]));
  for (std::size_t i = 1; i < slopes_.size(); ++i) kinks_.push_back({x_[i], y_[i], slopes_[i - 1], slopes_[i]});
  if (kinks_.empty()) kinks_.push_back({x_[0], y_[0], slopes_[0], slopes_[0]});
  cut_into_buckets();
}

namespace
{

bool has_two_in_a_bucket(const OctaveBuckets& buckets, std::span<const double> points)
{
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (buckets.of(points[i]) == buckets.of(points[i - 1])) return true;
  }
  return false;
}

}  // namespace

void PiecewiseLinear::cut_into_buckets()
{
  constexpr std::size_t most_buckets = 1 << 14;
  const double width = x_.back() - x_.front();
  const std::span inner = std::span(x_).subspan(1, x_.size() - 2);
  for (int octaves = 0; octaves <= 32; ++octaves) {
    for (int bits = 0; bits <= 14; ++bits) {
      const OctaveBuckets buckets(x_.front(), x_.back(), std::ldexp(width, -octaves), bits);
      if (buckets.size() > (buckets_ ? buckets_->size() - 1 : most_buckets)) break;
      if (!has_two_in_a_bucket(buckets, inner)) buckets_ = buckets;
    }
  }
  if (!buckets_) return;

  std::vector<Kink> of_bucket;
  for (std::size_t b = 0, k = 0; b < buckets_->size(); ++b) {
    const double middle = 0.5 * (buckets_->start(b) + buckets_->start(b + 1));
    const auto distance = [&](std::size_t i) { return std::abs(kinks_[i].x - middle); };
    while (k + 1 < kinks_.size() && distance(k + 1) < distance(k)) ++k;
    of_bucket.push_back(kinks_[k]);
  }
  // The point within a bucket comes before one nearer to its middle beyond its end.
  for (const Kink& kink : kinks_) of_bucket[buckets_->of(kink.x)] = kink;
  kinks_ = std::move(of_bucket);
}

std::size_t PiecewiseLinear::segment_of(double x) const
{
  const auto inner = std::span(x_).subspan(1, x_.size() - 2);
  return static_cast<std::size_t>(std::upper_bound(inner.begin(), inner.end(), x) - inner.begin());
}

std::size_t PiecewiseLinear::last_kink_before(double x) const
{
  const std::size_t segment = segment_of(x);
  return segment == 0 ? 0 : segment - 1;
}

std::pair<double, double> PiecewiseLinear::slopes_beside_kink(double x) const
{
  const Kink& kink = kink_near(x);
  return {kink.left_slope, kink.right_slope};
}

}  // namespace tamp::components
