#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "components/moduli/elastic_model.hpp"

namespace tamp::components
{

/// Which states of a rectangle are in a model's range, kept for 256 x 256 parts of it: for models that would have to
/// evaluate themselves to say so. Outside of the rectangle none is.
class RangeMask
{
 public:
  /// `in_range(elastic, plastic)` is asked in the middle of every part.
  template <class InRange>
  RangeMask(const StrainRange& range, const InRange& in_range) : range_(range)
  {
    const double width = (range.most_elastic - range.least_elastic) / n;
    const double height = (range.most_plastic - range.least_plastic) / n;
    per_elastic_ = 1 / width;
    per_plastic_ = 1 / height;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        yes_.push_back(in_range(range.least_elastic + (static_cast<double>(i) + 0.5) * width,
                                range.least_plastic + (static_cast<double>(j) + 0.5) * height));
      }
    }
  }

  bool operator()(double elastic, double plastic) const
  {
    if (!range_.contains(elastic, plastic)) return false;
    const auto i = static_cast<std::size_t>((elastic - range_.least_elastic) * per_elastic_);
    const auto j = static_cast<std::size_t>((plastic - range_.least_plastic) * per_plastic_);
    return yes_[std::min(j, n - 1) * n + std::min(i, n - 1)];
  }

 private:
  static constexpr std::size_t n = 256;
  StrainRange range_;
  double per_elastic_, per_plastic_;
  std::vector<bool> yes_;
};

}  // namespace tamp::components
