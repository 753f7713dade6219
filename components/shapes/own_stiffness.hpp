#pragma once

#include <algorithm>

#include "components/portable_math.hpp"

namespace tamp::components
{

/// The own stiffness of a particle alone, at worst: `along_axis` is the greatest sum over its nodes along an axis of
/// the slope squared over the weight, in cells.
inline double greatest_own_stiffness(int dimension, int n_per_axis, double along_axis)
{
  return portable::pow(std::max(1.0, 0.5 * n_per_axis), dimension - 1) * dimension * along_axis;
}

/// The most that the hoop of a particle alone adds to its own stiffness, half its size from the axis: (h / r)^2.
inline double greatest_hoop_stiffness(int n_per_axis)
{
  return std::max(1.0, 0.5 * n_per_axis) * 4 * n_per_axis * n_per_axis;
}

}  // namespace tamp::components
