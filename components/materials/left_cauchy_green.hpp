#pragma once

#include <numbers>

#include "components/lanes.hpp"
#include "components/portable_math.hpp"
#include "components/tensors.hpp"

/// Quantities of a deformation gradient F that neo-Hookean solids need.
namespace tamp::components
{

/// b = F F^T with b_33 = 1 in plane strain.
template <int D, class Number>
SymmetricTensor<D, Number> left_cauchy_green(const Matrix<D, Number>& f)
{
  return symmetric_part<D>(f * f.transpose(), 1.0);
}

/// The least and the greatest principal value of a symmetric tensor.
template <class Number>
struct PrincipalExtremes {
  Number least, greatest;
};

/// Least and greatest principal value in plane strain.
template <class Number>
PrincipalExtremes<Number> principal_extremes(const Eigen::Matrix<Number, 4, 1>& b)
{
  const Number middle = 0.5 * (b[0] + b[1]), half = 0.5 * (b[0] - b[1]);
  const Number radius = sqrt(half * half + b[3] * b[3]);
  return {lesser_of<Number>(middle - radius, b[2]), greater_of<Number>(middle + radius, b[2])};
}

/// In space, by the angle of the deviator, as the cubic has three real roots (O. K. Smith, Comm. ACM 4, 1961). Where
/// two values are almost equal they are good to 1e-8 of their distance from the third.
template <class Number>
PrincipalExtremes<Number> principal_extremes(const Eigen::Matrix<Number, 6, 1>& b)
{
  const Eigen::Matrix<Number, 6, 1> s = deviator(b);
  const Number middle = trace(b) / 3, radius = sqrt(double_dot(s, s) / 6);
  const Number cosine = 0.5 * plane_part<3, Number>(s).determinant() / (radius * radius * radius);
  // In this order a cosine that is not a number counts as -1: without a radius any will do.
  const Number lode_angle = portable::acos(lesser_of<Number>(greater_of<Number>(-1.0, cosine), 1.0)) / 3;
  return {middle + 2 * radius * portable::cos(lode_angle + 2 * std::numbers::pi / 3),
          middle + 2 * radius * portable::cos(lode_angle)};
}

}  // namespace tamp::components
