#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace tamp::components
{

/// Calls `visit` for every index lower <= i < upper, x fastest.
template <std::size_t D, class Visit>
void for_each_index(const std::array<int, D>& lower, const std::array<int, D>& upper, Visit&& visit)
{
  for (std::size_t k = 0; k < D; ++k) {
    if (lower[k] >= upper[k]) return;
  }
  std::array<int, D> i = lower;
  while (true) {
    visit(std::as_const(i));
    std::size_t k = 0;
    while (k < D && ++i[k] == upper[k]) {
      i[k] = lower[k];
      ++k;
    }
    if (k == D) return;
  }
}

/// Calls `visit` for every index 0 <= i < n along D axes.
template <std::size_t D, class Visit>
void for_each_index_below(int n, Visit&& visit)
{
  std::array<int, D> first, last;
  first.fill(0);
  last.fill(n);
  for_each_index(first, last, visit);
}

}  // namespace tamp::components
