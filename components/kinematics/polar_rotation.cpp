#include "components/kinematics/polar_rotation.hpp"

#include <Eigen/Geometry>

namespace tamp::components
{
namespace
{

template <class Number>
Matrix<3, Number> cofactors_of(const Matrix<3, Number>& x)
{
  Matrix<3, Number> cofactors;
  cofactors.col(0) = x.col(1).cross(x.col(2));
  cofactors.col(1) = x.col(2).cross(x.col(0));
  cofactors.col(2) = x.col(0).cross(x.col(1));
  return cofactors;
}

/// The inverse of the transpose: cofactors over the determinant.
Matrix<3> inverse_transpose(const Matrix<3>& x)
{
  const Matrix<3> cofactors = cofactors_of(x);
  return cofactors / x.col(0).dot(cofactors.col(0));
}

/// First and second invariant of U from those of C = U^2 and the third of U. They solve i1^2 = I_C + 2 i2 and
/// i2^2 = II_C + 2 i3 i1: i1 is the fixed point of a function whose slope i3 / (i1 i2) is never above 1/9. So two steps
/// of Newton's method from sqrt(3 I_C), which is never below i1, leave an error of 1e-8 of i1 for any U, and none to
/// speak of where the stretches differ by less than a tenth.
struct StretchInvariants {
  Lanes first, second;

  StretchInvariants(const Lanes& first_of_c, const Lanes& second_of_c, const Lanes& third)
  {
    const auto second_at = [&](const Lanes& i1) { return sqrt(second_of_c + 2.0 * third * i1); };
    first = sqrt(3.0 * first_of_c);
    for (int step = 0; step < 2; ++step) {
      const Lanes i2 = second_at(first), next = sqrt(first_of_c + 2.0 * i2);
      first += (next - first) / (1.0 - third / (next * i2));
    }
    second = second_at(first);
  }
};

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

Matrix<3, Lanes> polar_rotation(const Matrix<3, Lanes>& f)
{
  const Matrix<3, Lanes> cofactors = cofactors_of(f), c = f.transpose() * f;
  const Lanes first_of_c = c.trace(), third = f.col(0).dot(cofactors.col(0));
  const StretchInvariants u(first_of_c, cofactors.squaredNorm(), third);

  const Lanes per_product = 1.0 / (u.first * u.second - third);
  const Matrix<3, Lanes> r = per_product * ((u.second + first_of_c) * f - f * c + u.first * cofactors);
  const Matrix<3, Lanes> stretch = r.transpose() * r;
  return Lanes(1.5) * r - Lanes(0.5) * (r * stretch);
}

}  // namespace tamp::components
