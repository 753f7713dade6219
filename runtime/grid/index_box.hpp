#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace tamp::runtime
{

/// A cell or a node of the grid. In two dimensions the third entry is 0 and every box is one layer thick there.
using Index = std::array<int, 3>;

/// A box of cells or nodes, half open: lower <= i < upper along every axis.
struct IndexBox {
  Index lower{0, 0, 0};
  Index upper{0, 0, 0};

  int extent(int axis) const { return upper[axis_of(axis)] - lower[axis_of(axis)]; }

  bool empty() const { return extent(0) <= 0 || extent(1) <= 0 || extent(2) <= 0; }

  std::int64_t size() const
  {
    return empty() ? 0 : std::int64_t{extent(0)} * std::int64_t{extent(1)} * std::int64_t{extent(2)};
  }

  bool contains(const Index& i) const
  {
    return i[0] >= lower[0] && i[0] < upper[0] && i[1] >= lower[1] && i[1] < upper[1] && i[2] >= lower[2] &&
           i[2] < upper[2];
  }

  /// Steps between neighbours along each axis when the box is stored with x fastest.
  std::array<std::ptrdiff_t, 3> strides() const
  {
    return {1, extent(0), std::ptrdiff_t{extent(0)} * std::ptrdiff_t{extent(1)}};
  }

  friend bool operator==(const IndexBox&, const IndexBox&) = default;

 private:
  static constexpr std::size_t axis_of(int axis) { return static_cast<std::size_t>(axis); }
};

inline IndexBox intersection(const IndexBox& a, const IndexBox& b)
{
  IndexBox c;
  for (std::size_t k = 0; k < 3; ++k) {
    c.lower[k] = std::max(a.lower[k], b.lower[k]);
    c.upper[k] = std::min(a.upper[k], b.upper[k]);
  }
  return c;
}

/// `box` with `halo` more layers on both sides of each of the first `dimension` axes.
inline IndexBox grown(IndexBox box, int halo, int dimension)
{
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
    box.lower[k] -= halo;
    box.upper[k] += halo;
  }
  return box;
}

/// `box` with its indices `by` higher.
inline IndexBox moved(IndexBox box, const Index& by)
{
  for (std::size_t k = 0; k < 3; ++k) {
    box.lower[k] += by[k];
    box.upper[k] += by[k];
  }
  return box;
}

inline Index opposite(const Index& i)
{
  return {-i[0], -i[1], -i[2]};
}

/// Calls `visit(index)` for every index of the box, x fastest.
template <class Visit>
void for_each(const IndexBox& box, Visit&& visit)
{
  for (int k = box.lower[2]; k < box.upper[2]; ++k) {
    for (int j = box.lower[1]; j < box.upper[1]; ++j) {
      for (int i = box.lower[0]; i < box.upper[0]; ++i) visit(Index{i, j, k});
    }
  }
}

}  // namespace tamp::runtime
