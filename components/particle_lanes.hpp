#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "components/lanes.hpp"
#include "components/tensors.hpp"

/// The values of many particles, as many side by side as the processor has lanes.
namespace tamp::components
{

/// Those of n_lanes particles from `first` on, numbers or matrices; past the end that of the last.
template <class Value>
auto lanes_from(std::span<Value> values, std::size_t first)
{
  const auto place = [&](std::size_t l) { return std::min(first + l, values.size() - 1); };
  if constexpr (std::is_arithmetic_v<Value>) {
    if (first + n_lanes <= values.size()) return Lanes(&values[first], std::experimental::element_aligned);
    return each_lane([&](std::size_t l) { return values[place(l)]; });
  } else {
    Eigen::Matrix<Lanes, Value::RowsAtCompileTime, Value::ColsAtCompileTime> lanes;
    for (Eigen::Index i = 0; i < lanes.size(); ++i) {
      lanes(i) = each_lane([&](std::size_t l) { return values[place(l)](i); });
    }
    return lanes;
  }
}

/// Gives particles from `first` on, no more than there are, their values.
inline void set_from(const Lanes& lanes, std::size_t first, std::span<double> values)
{
  if (first + n_lanes <= values.size()) return lanes.copy_to(&values[first], std::experimental::element_aligned);
  for (std::size_t l = 0; l < values.size() - first; ++l) values[first + l] = lanes[l];
}

template <int Rows, int Columns>
void set_from(const Eigen::Matrix<Lanes, Rows, Columns>& lanes, std::size_t first,
              std::span<Eigen::Matrix<double, Rows, Columns>> values)
{
  std::array<std::array<double, n_lanes>, std::size_t{Rows * Columns}> by_component;
  for (std::size_t i = 0; i < by_component.size(); ++i) {
    lanes(static_cast<Eigen::Index>(i)).copy_to(by_component[i].data(), std::experimental::element_aligned);
  }
  for (std::size_t l = 0; l < std::min(n_lanes, values.size() - first); ++l) {
    for (std::size_t i = 0; i < by_component.size(); ++i) {
      values[first + l](static_cast<Eigen::Index>(i)) = by_component[i][l];
    }
  }
}

}  // namespace tamp::components
