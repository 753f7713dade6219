#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <experimental/simd>
#include <vector>

#include "components/lanes.hpp"

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
/// J. Strain, The fast Gauss transform, SIAM J. Sci. Stat. Comput. 12, 1991), its series economised (C. Lanczos,
/// Applied Analysis, 1956) to 8 terms in x and 12 in y. Tiles are so small that this costs each Gaussian 4e-19 of its
/// weight in x and 2e-18 in y: the sum and its first derivatives are exact to round-off, and the second one by x to
/// 1e-12 of the Gaussians' own.
class GaussianSum
{
 public:
  template <class Number>
  struct Values {
    Number f, by_x, by_y, by_xx, by_xy;
  };

  GaussianSum(const Gaussians& gaussians, Interval x, Interval y);

  void add(long double constant);

  /// From here on f(x, y) - f(y, y); the Gaussians are those of the constructor.
  void subtract_diagonal(const Gaussians& gaussians);

  /// The values at a point of the rectangle, or at one for each lane.
  template <class Number>
  Values<Number> at(const Number& x, const Number& y) const;
  /// The derivative by x alone.
  template <class Number>
  Number by_x_at(const Number& x, const Number& y) const;

 private:
  static constexpr std::size_t n_terms_x = 8, n_terms_y = 12;  // eight for the registers of any processor

  /// A number for each power of x.
  using Row = std::array<double, n_terms_x>;
  using RowInRegisters = std::experimental::fixed_size_simd<double, n_terms_x>;

  /// Evenly spaced tiles. Offsets from a tile's centre, -1/2 to 1/2, and all of a tile's terms are in tile widths.
  struct Axis {
    Axis(Interval interval, long double sharpness, double widths_per_tile);

    template <class Number>
    struct Place {
      Number tile, offset;
    };
    template <class Number>
    Place<Number> place(const Number& x) const
    {
      const Number widths = (x - low) * tiles_per_unit;
      const Number tile = lesser_of<Number>(truncated(widths), last_tile);
      return {tile, widths - tile - 0.5};
    }

    template <std::size_t n>
    std::array<long double, n> terms(long double centre, long double sharpness, std::size_t tile) const;

    double low;
    std::size_t n_tiles;
    double last_tile, tiles_per_unit;
  };

  struct alignas(64) Tile {
    std::array<Row, n_terms_y> rows;  // one for each power of y

    /// Sums the rows over the powers of y.
    void sum(double offset, Row& sums) const;
    void sum(double offset, Row& sums, Row& by_y) const;
  };
  /// The points' tiles.
  template <class Number>
  std::array<const Tile*, n_lanes_of<Number>> tiles_at(const Number& column, const Number& line) const;
  using ExactTile = std::array<std::array<long double, n_terms_x>, n_terms_y>;  // coefficients while a tile is added up

  void round_tiles();

  Axis x_, y_;
  std::vector<ExactTile> exact_tiles_;  // [y][x]
  std::vector<Tile> tiles_;             // the same, rounded
};

// First the sums over the powers of y, for one point after the other and all powers of x at a time; then those over the
// powers of x, for all points at a time; by Horner's rule. In y, where each step would wait for the one before, even
// and odd powers go side by side: e(v^2) + v o(v^2).

inline void GaussianSum::Tile::sum(double offset, Row& sums) const
{
  const auto row = [&](std::size_t n) { return RowInRegisters(rows[n].data(), std::experimental::element_aligned); };
  const double square = offset * offset;
  RowInRegisters even = row(n_terms_y - 2), odd = row(n_terms_y - 1);
  unrolled<n_terms_y / 2 - 1>([&](auto i) {
    constexpr std::size_t n = n_terms_y - 4 - 2 * i;
    even = even * square + row(n);
    odd = odd * square + row(n + 1);
  });
  (even + offset * odd).copy_to(sums.data(), std::experimental::element_aligned);
}

inline void GaussianSum::Tile::sum(double offset, Row& sums, Row& by_y) const
{
  const auto row = [&](std::size_t n) { return RowInRegisters(rows[n].data(), std::experimental::element_aligned); };
  const double square = offset * offset;
  RowInRegisters even_slope = row(n_terms_y - 2), even = even_slope * square + row(n_terms_y - 4);
  RowInRegisters odd_slope = row(n_terms_y - 1), odd = odd_slope * square + row(n_terms_y - 3);
  unrolled<n_terms_y / 2 - 2>([&](auto i) {
    constexpr std::size_t n = n_terms_y - 6 - 2 * i;
    even_slope = even_slope * square + even;
    odd_slope = odd_slope * square + odd;
    even = even * square + row(n);
    odd = odd * square + row(n + 1);
  });
  (even + offset * odd).copy_to(sums.data(), std::experimental::element_aligned);
  (odd + 2 * offset * (even_slope + offset * odd_slope)).copy_to(by_y.data(), std::experimental::element_aligned);
}

template <class Number>
inline auto GaussianSum::tiles_at(const Number& column, const Number& line) const
    -> std::array<const Tile*, n_lanes_of<Number>>
{
  const auto numbers = whole_parts(line * (x_.last_tile + 1) + column);
  std::array<const Tile*, n_lanes_of<Number>> tiles;
  for (std::size_t l = 0; l < tiles.size(); ++l) tiles[l] = &tiles_[static_cast<std::size_t>(numbers[l])];
  return tiles;
}

template <class Number>
inline GaussianSum::Values<Number> GaussianSum::at(const Number& x, const Number& y) const
{
  const Axis::Place<Number> column = x_.place(x), line = y_.place(y);
  const auto tiles = tiles_at(column.tile, line.tile);
  std::array<Row, n_lanes_of<Number>> sums, slopes;
  for (std::size_t l = 0; l < tiles.size(); ++l) tiles[l]->sum(lane(line.offset, l), sums[l], slopes[l]);
  const std::array<Number, n_terms_x> sum = side_by_side(sums), slope = side_by_side(slopes);

  Number f = sum.back(), by_x = 0.0, half_by_xx = 0.0, by_y = slope.back(), by_xy = 0.0;
  unrolled<n_terms_x - 1>([&](auto i) {
    constexpr std::size_t m = n_terms_x - 2 - i;
    half_by_xx = half_by_xx * column.offset + by_x;
    by_x = by_x * column.offset + f;
    f = f * column.offset + sum[m];
    by_xy = by_xy * column.offset + by_y;
    by_y = by_y * column.offset + slope[m];
  });
  const double per_x = x_.tiles_per_unit, per_y = y_.tiles_per_unit;
  return {f, per_x * by_x, per_y * by_y, 2 * per_x * per_x * half_by_xx, per_x * per_y * by_xy};
}

template <class Number>
inline Number GaussianSum::by_x_at(const Number& x, const Number& y) const
{
  const Axis::Place<Number> column = x_.place(x), line = y_.place(y);
  const auto tiles = tiles_at(column.tile, line.tile);
  std::array<Row, n_lanes_of<Number>> sums;
  for (std::size_t l = 0; l < tiles.size(); ++l) tiles[l]->sum(lane(line.offset, l), sums[l]);
  const std::array<Number, n_terms_x> sum = side_by_side(sums);

  Number f = sum[n_terms_x - 1] * column.offset + sum[n_terms_x - 2], by_x = sum[n_terms_x - 1];
  unrolled<n_terms_x - 2>([&](auto i) {
    by_x = by_x * column.offset + f;
    f = f * column.offset + sum[n_terms_x - 3 - i];
  });
  return x_.tiles_per_unit * by_x;
}

}  // namespace tamp::components
