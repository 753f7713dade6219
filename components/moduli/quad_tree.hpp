#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "components/lanes.hpp"

namespace tamp::components
{

/// A grid of squares, each of which is cut into four as often as wanted, and so are the quarters. The squares that are
/// left whole are the leaves, numbered from 0 in the order in which they came about.
///
/// A place is a fixed-point number for each axis, with `fraction_bits` behind the point and the side of an uncut square
/// as unit, so that finding a leaf costs no arithmetic but shifts, and the place in the leaf is exact.
class QuadTree
{
 public:
  static constexpr int fraction_bits = 46;
  static constexpr int most_cuts = 30;
  using Place = std::int64_t;

  QuadTree(std::int64_t n_columns, std::int64_t n_rows) : n_columns_(n_columns), n_rows_(n_rows)
  {
    while (n_leaves_ < n_columns * n_rows) slots_.push_back(~n_leaves_++);
  }

  struct Leaf {
    std::int32_t number;
    int side_bits;  ///< its side is two to this power, in the last place of the fixed-point numbers
  };

  bool contains(Place x, Place y) const
  {
    return x >= 0 && y >= 0 && x >> fraction_bits < n_columns_ && y >> fraction_bits < n_rows_;
  }

  /// The leaf around a place that the grid contains.
  Leaf find(Place x, Place y) const
  {
    const Slot slot = slot_of(x, y);
    return {~slots_[slot.index], slot.side_bits};
  }

  /// The leaves around points, which are given in squares from the grid's corner; what is outside of the grid counts as
  /// on its edge.
  template <class Number>
  struct Found {
    std::array<std::size_t, n_lanes_of<Number>> number;
    Number x, y;               ///< in the leaf, from 0 to 1
    Number leaves_per_square;  ///< in a row; a power of two
  };
  template <class Number>
  Found<Number> find_points(const Number& x, const Number& y) const
  {
    constexpr std::size_t n = n_lanes_of<Number>;
    constexpr auto unit = static_cast<double>(Place{1} << fraction_bits);
    const Number scaled_x = x * unit, scaled_y = y * unit;
    const Place last_x = (n_columns_ << fraction_bits) - 1, last_y = (n_rows_ << fraction_bits) - 1;
    std::array<std::size_t, n> number;
    std::array<double, n> in_x, in_y, side;
    for (std::size_t l = 0; l < n; ++l) {
      const Place place_x = std::clamp(static_cast<Place>(lane(scaled_x, l)), Place{0}, last_x);
      const Place place_y = std::clamp(static_cast<Place>(lane(scaled_y, l)), Place{0}, last_y);
      const Leaf leaf = find(place_x, place_y);
      const Place in_leaf = (Place{1} << leaf.side_bits) - 1;
      number[l] = static_cast<std::size_t>(leaf.number);
      in_x[l] = static_cast<double>(place_x & in_leaf);
      in_y[l] = static_cast<double>(place_y & in_leaf);
      side[l] = power_of_two(-leaf.side_bits);
    }
    const Number per_side = number_of<Number>(side);
    return {number, number_of<Number>(in_x) * per_side, number_of<Number>(in_y) * per_side, unit * per_side};
  }

  static double power_of_two(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52); }

  /// Cuts the leaf around a place in four: the lower left one keeps its number, and the lower right, upper left and
  /// upper right ones are numbered on from the last. The leaf has been cut less than `most_cuts` times.
  void cut(Place x, Place y)
  {
    const std::size_t index = slot_of(x, y).index;
    const std::int32_t leaf = ~slots_[index];
    slots_[index] = static_cast<std::int32_t>(slots_.size());
    slots_.push_back(~leaf);
    for (int i = 0; i < 3; ++i) slots_.push_back(~n_leaves_++);
  }

 private:
  struct Slot {
    std::size_t index;
    int side_bits;
  };
  Slot slot_of(Place x, Place y) const
  {
    int side_bits = fraction_bits;
    auto index = static_cast<std::size_t>((y >> side_bits) * n_columns_ + (x >> side_bits));
    while (slots_[index] >= 0) {
      --side_bits;
      index = static_cast<std::size_t>(slots_[index] + ((x >> side_bits) & 1) + 2 * ((y >> side_bits) & 1));
    }
    return {index, side_bits};
  }

  std::int64_t n_columns_, n_rows_;
  // A square that is cut: the first of its four quarters' slots. A leaf: the complement of its number, negative.
  std::vector<std::int32_t> slots_;
  std::int32_t n_leaves_ = 0;
};

}  // namespace tamp::components
