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

  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    segments_.push_back({x_[i], y_[i], (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i])});
  }

  const std::size_t n_buckets = 2 * segments_.size();
  const double width = (x_.back() - x_.front()) / static_cast<double>(n_buckets);
  buckets_per_x_ = 1 / width;
  last_bucket_ = static_cast<double>(n_buckets - 1);
  const auto last = static_cast<std::ptrdiff_t>(segments_.size()) - 1;
  const auto segment_at = [&](std::size_t edge) {
    const double x_edge = x_.front() + width * static_cast<double>(edge);
    return std::upper_bound(x_.begin(), x_.end(), x_edge) - x_.begin() - 1;
  };
  // One segment of slack on either side, so that round-off in a bucket's number cannot matter.
  for (std::size_t b = 0; b < n_buckets; ++b) {
    buckets_.push_back({static_cast<std::uint32_t>(std::clamp<std::ptrdiff_t>(segment_at(b) - 1, 0, last)),
                        static_cast<std::uint32_t>(std::clamp<std::ptrdiff_t>(segment_at(b + 1) + 1, 0, last))});
  }
}

}  // namespace tamp::components
