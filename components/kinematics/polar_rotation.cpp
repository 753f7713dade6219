#include "components/kinematics/polar_rotation.hpp"

#include <Eigen/Geometry>

namespace tamp::components
{
namespace
{

/// The inverse of the transpose: cofactors over the determinant.
Matrix<3> inverse_transpose(const Matrix<3>& x)
{
  Matrix<3> cofactors;
  cofactors.col(0) = x.col(1).cross(x.col(2));
  cofactors.col(1) = x.col(2).cross(x.col(0));
  cofactors.col(2) = x.col(0).cross(x.col(1));
  return cofactors / x.col(0).dot(cofactors.col(0));
}

}  // namespace

Matrix<3> polar_rotation(const Matrix<3>& f)
{
  // Squared distances. Where singular values are still apart, scaling brings them together; once X is close to
  // orthogonal it would only add round-off. After a move of size e the distance left is about e^2 / 2.
  constexpr double scaling_ends = 1e-4, converged = 1e-18;
  // Nine scaled iterations suffice for any condition number a double can hold; the bound only stops a NaN.
  constexpr int max_iterations = 30;

  Matrix<3> x = f;
  bool scaled = true;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const Matrix<3> y = inverse_transpose(x);
    const double scale = scaled ? std::sqrt(y.norm() / x.norm()) : 1.0;
    const Matrix<3> next = 0.5 * (scale * x + y / scale);
    const double move = (next - x).squaredNorm();
    x = next;
    if (move < converged) break;
    scaled = move > scaling_ends;
  }
  return x;
}

}  // namespace tamp::components
