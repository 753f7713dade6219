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

/// A deformation gradient, and the first and the second invariant of its U. These solve i1^2 = I_C + 2 i2 and
/// i2^2 = II_C + 2 i3 i1, C = U^2: i1 is the fixed point of a function whose slope i3 / (i1 i2) is never above 1/9. So
/// two steps of Newton's method from sqrt(3 I_C), which is never below i1, leave an error of 1e-8 of i1 for any U, and
/// none to speak of where the stretches differ by less than a tenth.
struct Stretched {
  const Matrix<3, Lanes>& f;
  Matrix<3, Lanes> cofactors = cofactors_of(f), c = f.transpose() * f;
  Lanes first_of_c = c.trace(), second_of_c = cofactors.squaredNorm(), third = f.col(0).dot(cofactors.col(0));
  Lanes first = sqrt(3.0 * first_of_c);

  Lanes second() const { return sqrt(second_of_c + 2.0 * third * first); }

  void improve_first()
  {
    const Lanes i2 = second(), next = sqrt(first_of_c + 2.0 * i2);
    first += (next - first) / (1.0 - third / (next * i2));
  }

  Matrix<3, Lanes> rotation() const
  {
    const Lanes i2 = second(), per_product = 1.0 / (first * i2 - third);
    const Matrix<3, Lanes> r = per_product * ((i2 + first_of_c) * f - f * c + first * cofactors);
    const Matrix<3, Lanes> stretch = r.transpose() * r;
    return Lanes(1.5) * r - Lanes(0.5) * (r * stretch);
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

[[gnu::flatten]] std::array<Matrix<3, Lanes>, 2> polar_rotations(const Matrix<3, Lanes>& f, const Matrix<3, Lanes>& g)
{
  Stretched of_f{f}, of_g{g};
  for (int step = 0; step < 2; ++step) {
    of_f.improve_first();
    of_g.improve_first();
  }
  return {of_f.rotation(), of_g.rotation()};
}

}  // namespace tamp::components
