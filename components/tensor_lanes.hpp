#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "components/lanes.hpp"
#include "components/tensors.hpp"

namespace tamp
{

/// The tensors of particles from `first` on side by side; where they end, the last one again.
template <class Tensor, int Rows = Tensor::RowsAtCompileTime, int Columns = Tensor::ColsAtCompileTime>
[[gnu::always_inline]] inline Eigen::Matrix<Lanes, Rows, Columns> lanes_at(std::span<Tensor> tensors, std::size_t first)
{
  std::array<const double*, n_lanes> places;
  for (std::size_t l = 0; l < n_lanes; ++l) places[l] = tensors[std::min(first + l, tensors.size() - 1)].data();
  constexpr std::size_t n = Rows * Columns;
  const std::array<Lanes, n> numbers = side_by_side<n>(places);
  Eigen::Matrix<Lanes, Rows, Columns> side;
  unrolled<n>([&](auto i) { side.data()[i] = numbers[i]; });
  return side;
}

/// Writes them back, as many as there are.
template <int Rows, int Columns>
[[gnu::always_inline]] inline void set_lanes(std::span<Eigen::Matrix<double, Rows, Columns>> tensors, std::size_t first,
                                             const Eigen::Matrix<Lanes, Rows, Columns>& side)
{
  constexpr std::size_t n = Rows * Columns;
  std::array<Lanes, n> numbers;
  unrolled<n>([&](auto i) { numbers[i] = side.data()[i]; });
  std::array<double*, n_lanes> places;
  for (std::size_t l = 0; l < n_lanes; ++l) places[l] = tensors[std::min(first + l, tensors.size() - 1)].data();
  set_side_by_side(numbers, places, std::min(n_lanes, tensors.size() - first));
}

}  // namespace tamp
