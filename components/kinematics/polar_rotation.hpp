#pragma once

#include <Eigen/Core>
#include <array>

#include "components/lanes.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The rotation R of the polar decomposition F = R U, U symmetric and positive definite, to round-off. det F must be
/// above 0. In the plane it is the rotation for which R^T F is symmetric with a positive trace. Without a branch, so
/// that `Number` may be Lanes.
template <class Number>
Matrix<2, Number> polar_rotation(const Matrix<2, Number>& f)
{
  const Number cosine = f(0, 0) + f(1, 1), sine = f(1, 0) - f(0, 1);
  const Number length = sqrt(cosine * cosine + sine * sine);
  return (Matrix<2, Number>() << cosine, -sine, sine, cosine).finished() / length;
}

/// In space: scaled Newton iteration X <- (g X + X^-T / g) / 2 from X = F, whose limit is R and whose convergence is
/// quadratic (N. J. Higham, Computing the polar decomposition - with applications, SIAM J. Sci. Stat. Comput. 7, 1986).
Matrix<3> polar_rotation(const Matrix<3>& f);

/// The rotations of two deformation gradients.
template <int D, class Number>
std::array<Matrix<D, Number>, 2> polar_rotations(const Matrix<D, Number>& f, const Matrix<D, Number>& g)
{
  return {polar_rotation(f), polar_rotation(g)};
}

/// The rotations of two deformation gradients without a branch: R = ((i2 + I_C) F - F C + i1 cof F) / (i1 i2 - i3), C =
/// F^T F, by the theorem of Cayley and Hamilton from the invariants i of U. These leave R a stretch close to 1, which R
/// (3 I - R^T R) / 2 squares away: R is orthogonal to round-off up to stretches a thousand times apart. Beyond,
/// round-off in det F gains on it, and the caller has to see whether R is still orthogonal, or even a number. Two at a
/// time take little longer than one: roots and quotients that wait for each other make up most of it.
std::array<Matrix<3, Lanes>, 2> polar_rotations(const Matrix<3, Lanes>& f, const Matrix<3, Lanes>& g);

}  // namespace tamp::components
