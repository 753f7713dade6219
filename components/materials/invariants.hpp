#pragma once

#include <cmath>

#include "components/tensors.hpp"

namespace tamp::components
{

/// The parts of a stress that do not depend on the axes [Pa].
struct Invariants {
  double pressure;  ///< -tr sigma / 3, compression positive
  double j2;        ///< s:s / 2 of the deviator s [Pa^2]

  double sqrt_j2() const { return std::sqrt(j2); }
  /// The equivalent stress of von Mises, sqrt(3 J2).
  double q() const { return std::sqrt(3 * j2); }
};

/// J2 = s:s / 2 of a deviator.
template <int Size>
double j2_of(const Eigen::Matrix<double, Size, 1>& s)
{
  return 0.5 * double_dot(s, s);
}

template <int Size>
Invariants invariants(const Eigen::Matrix<double, Size, 1>& stress)
{
  return {-trace(stress) / 3, j2_of<Size>(deviator(stress))};
}

}  // namespace tamp::components
