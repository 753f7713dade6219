#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <experimental/simd>
#include <vector>

namespace tamp::components
{

/// f(x, y) = sum_j weight_j exp(-sharpness_x (x - x_j)^2 - sharpness_y (y - y_j)^2). In long double, as sums of large
/// weights of both signs are small: round-off of the numbers here would be most of the result's.
struct Gaussians {
  struct Peak {
    long double x, y, weight;
  };
  long double sharpness_x, sharpness_y;
  std::vector<Peak> peaks;
};

struct Interval {
  double low, high;
};

/// A sum of Gaussians over a rectangle, with its derivatives, at a cost that does not depend on how many they are.
///
/// A Gaussian separates in its two variables, and so does its Taylor series: on a tile with centre c,
///     f(c + u) = sum_mn C_mn u_x^m u_y^n,   C_mn = sum_j weight_j h_m(x_j - c_x) h_n(y_j - c_y),
/// where exp(-s (t - u)^2) = sum_n h_n(t) u^n. This is the local expansion of the fast Gauss transform (L. Greengard,
/// J. Strain, The fast Gauss transform, SIAM J. Sci. Stat. Comput. 12, 1991). It is cut off at 16 terms an axis, on
/// tiles so small that this costs each Gaussian 1.2e-16 of its weight an axis: the result is the sum to round-off.
class GaussianSum
{
 public:
  struct Values {
    double f, by_x, by_y, by_xx, by_xy;
  };

  GaussianSum(const Gaussians& gaussians, Interval x, Interval y);

  void add(long double constant);

  /// From here on f(x, y) - f(y, y); the Gaussians are those of the constructor.
  void subtract_diagonal(const Gaussians& gaussians);

  /// At a point of the rectangle.
  Values at(double x, double y) const;

 private:
  static constexpr std::size_t n_terms = 16;
  static constexpr std::size_t n_lanes = n_terms / 2;
  using Terms = std::array<long double, n_terms>;
  using Lanes = std::experimental::fixed_size_simd<double, n_lanes>;

  /// One value for each power of x.
  struct Row {
    Lanes low, high;

    Row times(double factor, const Row& other) const;
    double dot(const Row& other) const;
  };

  /// u^m, m u^(m-1) and m (m-1) u^(m-2).
  struct Powers {
    Row value, slope, bend;

    explicit Powers(double u);
  };

  /// Evenly spaced tiles. Offsets from a tile's centre, -1/2 to 1/2, and all of a tile's terms are in tile widths.
  struct Axis {
    struct Place {
      std::size_t tile;
      double offset;
    };
    Axis(Interval interval, long double sharpness);

    Place place(double x) const
    {
      const double widths = (x - low) * tiles_per_unit;
      const std::size_t tile = std::min(static_cast<std::size_t>(widths), n_tiles - 1);
      return {tile, widths - static_cast<double>(tile) - 0.5};
    }

    Terms terms(long double centre, long double sharpness, std::size_t tile) const;

    double low;
    std::size_t n_tiles;
    double tiles_per_unit;
  };

  using Tile = std::array<Row, n_terms>;         // one row for each power of y
  using ExactTile = std::array<Terms, n_terms>;  // what tiles are added up in

  void round_tiles();

  Axis x_, y_;
  std::vector<ExactTile> exact_tiles_;  // [y][x]
  std::vector<Tile> tiles_;             // the same, rounded
};

/// this * factor + other
inline GaussianSum::Row GaussianSum::Row::times(double factor, const Row& other) const
{
  return {low * factor + other.low, high * factor + other.high};
}

inline double GaussianSum::Row::dot(const Row& other) const
{
  // Halves are added to halves: the library's own sum has an order for each processor.
  std::array<double, n_lanes> sum;
  (low * other.low + high * other.high).copy_to(sum.data(), std::experimental::element_aligned);
  for (std::size_t half = n_lanes / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) sum[i] += sum[i + half];
  }
  return sum[0];
}

[[gnu::always_inline]] inline GaussianSum::Powers::Powers(double u)
{
  const double u2 = u * u, u3 = u2 * u, u4 = u2 * u2, u5 = u4 * u, u6 = u4 * u2, u7 = u4 * u3, u8 = u4 * u4;
  const std::array<double, n_lanes> powers{1, u, u2, u3, u4, u5, u6, u7};
  const Lanes first([&](auto m) { return powers[m]; });
  const Lanes before([&](auto m) { return m < 1 ? 0 : powers[m - 1]; });
  const Lanes before_that([&](auto m) { return m < 2 ? 0 : powers[m - 2]; });
  const Lanes m([](auto lane) { return static_cast<double>(lane); }), m8 = m + 8.0;
  value = {first, first * u8};
  slope = {m * before, m8 * first * u7};
  bend = {m * (m - 1.0) * before_that, m8 * (m8 - 1.0) * first * u6};
}

/// Inlined so that what a caller does not ask for is not computed.
[[gnu::always_inline]] inline GaussianSum::Values GaussianSum::at(double x, double y) const
{
  const Axis::Place column = x_.place(x), line = y_.place(y);
  const Tile& tile = tiles_[line.tile * x_.n_tiles + column.tile];

  // By Horner's rule the sums over the powers of y, and their derivatives by y.
  Row sums = tile.back(), by_y{0, 0};
  for (std::size_t n = n_terms - 1; n-- > 0;) {
    by_y = by_y.times(line.offset, sums);
    sums = sums.times(line.offset, tile[n]);
  }

  const Powers powers(column.offset);
  const double per_x = x_.tiles_per_unit, per_y = y_.tiles_per_unit;
  return {sums.dot(powers.value), per_x * sums.dot(powers.slope), per_y * by_y.dot(powers.value),
          per_x * per_x * sums.dot(powers.bend), per_x * per_y * by_y.dot(powers.slope)};
}

}  // namespace tamp::components
