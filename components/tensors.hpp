#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <type_traits>

/// Small tensors of the mechanics. D is the dimension of the method: 2 is plane strain, 3 is space.
namespace tamp
{

template <int D, class Number = double>
using Vector = Eigen::Matrix<Number, D, 1>;

template <int D, class Number = double>
using Matrix = Eigen::Matrix<Number, D, D>;

/// Components of a symmetric 3x3 tensor that a D-dimensional scene can hold: the plane-strain one keeps its zz.
template <int D>
inline constexpr int n_symmetric = D == 2 ? 4 : 6;

/// A symmetric tensor as (xx, yy, zz, xy) in plane strain and (xx, yy, zz, xy, yz, xz) in space; shear components
/// are tensor components (half the engineering strain). Tension positive.
template <int D, class Number = double>
using SymmetricTensor = Eigen::Matrix<Number, n_symmetric<D>, 1>;

template <class Number, int Size>
Number trace(const Eigen::Matrix<Number, Size, 1>& a)
{
  return a[0] + a[1] + a[2];
}

/// a : b, every off-diagonal component counted twice.
template <class Number, int Size>
Number double_dot(const Eigen::Matrix<Number, Size, 1>& a, const Eigen::Matrix<Number, Size, 1>& b)
{
  Number diagonal = 0.0, shear = 0.0;
  for (int i = 0; i < 3; ++i) diagonal += a[i] * b[i];
  for (int i = 3; i < Size; ++i) shear += a[i] * b[i];
  return diagonal + 2.0 * shear;
}

template <class Number, int Size>
Eigen::Matrix<Number, Size, 1> deviator(Eigen::Matrix<Number, Size, 1> a)
{
  const Number mean = trace(a) / 3.0;
  for (int i = 0; i < 3; ++i) a[i] -= mean;
  return a;
}

template <int Size, class Number = double>
Eigen::Matrix<Number, Size, 1> isotropic(const std::type_identity_t<Number>& value)
{
  Eigen::Matrix<Number, Size, 1> a = Eigen::Matrix<Number, Size, 1>::Zero();
  a.template head<3>().setConstant(value);
  return a;
}

/// [a]x, so that [a]x b = a x b.
inline Matrix<3> cross_matrix(const Vector<3>& a)
{
  return (Matrix<3>() << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0).finished();
}

/// The in-plane (D x D) part of a symmetric tensor as a matrix; plane strain leaves zz out.
template <int D, class Number>
Matrix<D, Number> plane_part(const Eigen::Matrix<Number, n_symmetric<D>, 1>& a)
{
  if constexpr (D == 2) {
    return (Matrix<2, Number>() << a[0], a[3], a[3], a[1]).finished();
  } else {
    return (Matrix<3, Number>() << a[0], a[3], a[5], a[3], a[1], a[4], a[5], a[4], a[2]).finished();
  }
}

/// The symmetric tensor with the symmetric part of `m` in the plane and `zz` out of it (ignored in space).
template <int D, class Expression, class Number = typename Expression::Scalar>
SymmetricTensor<D, Number> symmetric_part(const Expression& of, const std::type_identity_t<Number>& zz = 0.0)
{
  const Matrix<D, Number> m = of;
  const Number half = 0.5;
  SymmetricTensor<D, Number> a;
  if constexpr (D == 2) {
    a << m(0, 0), m(1, 1), zz, half * (m(0, 1) + m(1, 0));
  } else {
    a << m(0, 0), m(1, 1), m(2, 2), half * (m(0, 1) + m(1, 0)), half * (m(1, 2) + m(2, 1)), half * (m(0, 2) + m(2, 0));
  }
  return a;
}

/// R a R^T for a rotation R of the D-dimensional space.
template <int D, class Number>
SymmetricTensor<D, Number> rotated(const Eigen::Matrix<Number, n_symmetric<D>, 1>& a, const Matrix<D, Number>& rotation)
{
  return symmetric_part<D>(rotation * plane_part<D>(a) * rotation.transpose(), a[2]);
}

}  // namespace tamp
