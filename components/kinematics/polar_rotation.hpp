#pragma once

#include <cmath>

#include "components/tensors.hpp"

namespace tamp::components
{

/// The rotation R of the polar decomposition F = R U, U symmetric and positive definite, to round-off. det F must be
/// above 0. In the plane it is closed form: R is the rotation for which R^T F is symmetric with a positive trace.
inline Matrix<2> polar_rotation(const Matrix<2>& f)
{
  const double cosine = f(0, 0) + f(1, 1), sine = f(1, 0) - f(0, 1);
  const double length = std::sqrt(cosine * cosine + sine * sine);
  return (Matrix<2>() << cosine, -sine, sine, cosine).finished() / length;
}

/// In space: scaled Newton iteration X <- (g X + X^-T / g) / 2 from X = F, whose limit is R and whose convergence is
/// quadratic (N. J. Higham, Computing the polar decomposition - with applications, SIAM J. Sci. Stat. Comput. 7, 1986).
Matrix<3> polar_rotation(const Matrix<3>& f);

}  // namespace tamp::components
