#include "components/moduli/gaussian_sum.hpp"

#include <cmath>

namespace tamp::components
{

namespace
{

// By Cramer's inequality term n is at most 1.09 v^n / sqrt(n!) at a tile's edge, with v = widths_per_tile / sqrt(2).
// Together those that are left out are 1.2e-16.
constexpr double widths_per_tile = 0.37;  // in 1 / sqrt(sharpness)

}  // namespace

GaussianSum::Axis::Axis(Interval interval, long double sharpness)
    : low(interval.low),
      n_tiles(static_cast<std::size_t>((interval.high - interval.low) * std::sqrt(sharpness) / widths_per_tile) + 1),
      tiles_per_unit(static_cast<double>(n_tiles) / (interval.high - interval.low))
{
}

GaussianSum::Terms GaussianSum::Axis::terms(long double centre, long double sharpness, std::size_t tile) const
{
  const long double t = (centre - low) * tiles_per_unit - static_cast<long double>(tile) - 0.5L;
  const long double s = sharpness / (static_cast<long double>(tiles_per_unit) * tiles_per_unit);
  // Both sides of d/du exp(-s (t - u)^2) = 2 s (t - u) exp(-s (t - u)^2), power by power.
  Terms h;
  h[0] = std::exp(-s * t * t);
  h[1] = 2 * s * t * h[0];
  for (std::size_t n = 1; n + 1 < n_terms; ++n) {
    h[n + 1] = 2 * s * (t * h[n] - h[n - 1]) / static_cast<long double>(n + 1);
  }
  return h;
}

// Along the diagonal the sum is as sharp as both together, and the tiles are narrow enough in y for that.
GaussianSum::GaussianSum(const Gaussians& gaussians, Interval x, Interval y)
    : x_(x, gaussians.sharpness_x),
      y_(y, gaussians.sharpness_x + gaussians.sharpness_y),
      exact_tiles_(x_.n_tiles * y_.n_tiles, ExactTile{}),
      tiles_(exact_tiles_.size())
{
  std::vector<Terms> in_x(x_.n_tiles);
  for (const Gaussians::Peak& peak : gaussians.peaks) {
    for (std::size_t i = 0; i < x_.n_tiles; ++i) in_x[i] = x_.terms(peak.x, gaussians.sharpness_x, i);
    for (std::size_t j = 0; j < y_.n_tiles; ++j) {
      const Terms in_y = y_.terms(peak.y, gaussians.sharpness_y, j);
      for (std::size_t i = 0; i < x_.n_tiles; ++i) {
        ExactTile& tile = exact_tiles_[j * x_.n_tiles + i];
        for (std::size_t n = 0; n < n_terms; ++n) {
          for (std::size_t m = 0; m < n_terms; ++m) tile[n][m] += peak.weight * in_y[n] * in_x[i][m];
        }
      }
    }
  }
  round_tiles();
}

void GaussianSum::add(long double constant)
{
  for (ExactTile& tile : exact_tiles_) tile[0][0] += constant;
  round_tiles();
}

// On the diagonal each Gaussian is one of y alone: its centre is the mean of x_j and y_j by sharpness, and how far they
// are apart lowers its weight.
void GaussianSum::subtract_diagonal(const Gaussians& gaussians)
{
  const long double sharpness = gaussians.sharpness_x + gaussians.sharpness_y;
  for (const auto& [x, y, weight] : gaussians.peaks) {
    const long double centre = (gaussians.sharpness_x * x + gaussians.sharpness_y * y) / sharpness;
    const long double on_diagonal =
        weight * std::exp(-gaussians.sharpness_x * gaussians.sharpness_y / sharpness * (x - y) * (x - y));
    for (std::size_t j = 0; j < y_.n_tiles; ++j) {
      const Terms in_y = y_.terms(centre, sharpness, j);
      for (std::size_t i = 0; i < x_.n_tiles; ++i) {
        ExactTile& tile = exact_tiles_[j * x_.n_tiles + i];
        for (std::size_t n = 0; n < n_terms; ++n) tile[n][0] -= on_diagonal * in_y[n];
      }
    }
  }
  round_tiles();
}

void GaussianSum::round_tiles()
{
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    for (std::size_t n = 0; n < n_terms; ++n) {
      const Terms& terms = exact_tiles_[i][n];
      const auto rounded = [&](std::size_t first) {
        return Lanes([&](auto m) { return static_cast<double>(terms[first + m]); });
      };
      tiles_[i][n] = {rounded(0), rounded(n_lanes)};
    }
  }
}

}  // namespace tamp::components
