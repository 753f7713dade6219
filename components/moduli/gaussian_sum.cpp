#include "components/moduli/gaussian_sum.hpp"

#include <cmath>
#include <span>

#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

// In 1 / sqrt(sharpness). By Cramer's inequality term n of a Gaussian's series is at most 1.09 v^n / sqrt(n!) at a
// tile's edge, with v = widths_per_tile / sqrt(2), and what economising leaves of it that over 2^(n - 1).
constexpr double widths_per_tile_x = 0.025, widths_per_tile_y = 0.2;

/// From the last term to the first that is kept each is replaced by the polynomial of lower order that is closest to it
/// on the tile: a power less its Chebyshev polynomial, whose coefficients are in a fixed ratio.
void economise(std::span<long double> terms, std::size_t n_kept)
{
  for (std::size_t n = terms.size() - 1; n >= n_kept; --n) {
    long double coefficient = terms[n];
    for (std::size_t k = n; k >= 2; k -= 2) {
      const auto pairs = static_cast<long double>(k * (k - 1)),
                 others = static_cast<long double>((n - k + 2) * (n + k - 2));
      coefficient *= -pairs / (4 * others);
      terms[k - 2] -= coefficient;
    }
  }
}

}  // namespace

GaussianSum::Axis::Axis(Interval interval, long double sharpness, double widths_per_tile)
    : low(interval.low),
      n_tiles(static_cast<std::size_t>((interval.high - interval.low) * std::sqrt(sharpness) / widths_per_tile) + 1),
      last_tile(static_cast<double>(n_tiles - 1)),
      tiles_per_unit(static_cast<double>(n_tiles) / (interval.high - interval.low))
{
}

template <std::size_t n_terms>
std::array<long double, n_terms> GaussianSum::Axis::terms(long double centre, long double sharpness,
                                                          std::size_t tile) const
{
  const long double t = (centre - low) * tiles_per_unit - static_cast<long double>(tile) - 0.5L;
  const long double s = sharpness / (static_cast<long double>(tiles_per_unit) * tiles_per_unit);
  // Both sides of d/du exp(-s (t - u)^2) = 2 s (t - u) exp(-s (t - u)^2), power by power.
  std::array<long double, n_terms + 6> h;
  h[0] = portable::exp(-s * t * t);
  h[1] = 2 * s * t * h[0];
  for (std::size_t n = 1; n + 1 < h.size(); ++n) {
    h[n + 1] = 2 * s * (t * h[n] - h[n - 1]) / static_cast<long double>(n + 1);
  }
  economise(h, n_terms);
  std::array<long double, n_terms> kept;
  std::copy_n(h.begin(), n_terms, kept.begin());
  return kept;
}

// Along the diagonal the sum is as sharp as both together, and the tiles are narrow enough in y for that.
GaussianSum::GaussianSum(const Gaussians& gaussians, Interval x, Interval y)
    : x_(x, gaussians.sharpness_x, widths_per_tile_x),
      y_(y, gaussians.sharpness_x + gaussians.sharpness_y, widths_per_tile_y),
      exact_tiles_(x_.n_tiles * y_.n_tiles, ExactTile{}),
      tiles_(exact_tiles_.size())
{
  std::vector<std::array<long double, n_terms_x>> in_x(x_.n_tiles);
  for (const Gaussians::Peak& peak : gaussians.peaks) {
    for (std::size_t i = 0; i < x_.n_tiles; ++i) in_x[i] = x_.terms<n_terms_x>(peak.x, gaussians.sharpness_x, i);
    for (std::size_t j = 0; j < y_.n_tiles; ++j) {
      const auto in_y = y_.terms<n_terms_y>(peak.y, gaussians.sharpness_y, j);
      for (std::size_t i = 0; i < x_.n_tiles; ++i) {
        ExactTile& tile = exact_tiles_[j * x_.n_tiles + i];
        for (std::size_t n = 0; n < n_terms_y; ++n) {
          for (std::size_t m = 0; m < n_terms_x; ++m) tile[n][m] += peak.weight * in_y[n] * in_x[i][m];
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
        weight * portable::exp(-gaussians.sharpness_x * gaussians.sharpness_y / sharpness * (x - y) * (x - y));
    for (std::size_t j = 0; j < y_.n_tiles; ++j) {
      const auto in_y = y_.terms<n_terms_y>(centre, sharpness, j);
      for (std::size_t i = 0; i < x_.n_tiles; ++i) {
        ExactTile& tile = exact_tiles_[j * x_.n_tiles + i];
        for (std::size_t n = 0; n < n_terms_y; ++n) tile[n][0] -= on_diagonal * in_y[n];
      }
    }
  }
  round_tiles();
}

void GaussianSum::round_tiles()
{
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    for (std::size_t n = 0; n < n_terms_y; ++n) {
      for (std::size_t m = 0; m < n_terms_x; ++m) tiles_[i].rows[n][m] = static_cast<double>(exact_tiles_[i][n][m]);
    }
  }
}

}  // namespace tamp::components
