#pragma once

#include <array>

#include "components/lanes.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The principal values of a symmetric tensor, the greatest first.
template <class Number>
using PrincipalValues = std::array<Number, 3>;

/// A symmetric tensor by its principal values and axes. Without a branch, so that `Number` may be Lanes.
template <int D, class Number>
class Principal;

/// Plane strain: one axis is that out of the plane, and the others come from Mohr's circle.
template <class Number>
class Principal<2, Number>
{
 public:
  explicit Principal(const SymmetricTensor<2, Number>& a) : zz_(a[2])
  {
    const Number middle = 0.5 * (a[0] + a[1]), half = 0.5 * (a[0] - a[1]), radius = sqrt(half * half + a[3] * a[3]);
    const Mask<Number> round = !(radius > 0.0);
    const Number divisor = select(round, Number(1.0), radius);
    cos_ = select(round, Number(1.0), half / divisor);
    sin_ = select(round, Number(0.0), a[3] / divisor);
    upper_ = middle + radius;
    lower_ = middle - radius;
  }

  PrincipalValues<Number> values() const
  {
    return {greater_of(upper_, zz_), greater_of(lower_, lesser_of(upper_, zz_)), lesser_of(lower_, zz_)};
  }

  /// The tensor that has other values, in the same order, on the same axes.
  SymmetricTensor<2, Number> with(const PrincipalValues<Number>& v) const
  {
    const Mask<Number> first = zz_ > upper_, last = zz_ < lower_;
    const Number zz = select(first, v[0], select(last, v[2], v[1]));
    const Number upper = select(first, v[1], v[0]), lower = select(last, v[1], v[2]);
    const Number middle = 0.5 * (upper + lower), radius = 0.5 * (upper - lower);
    SymmetricTensor<2, Number> a;
    a << middle + radius * cos_, middle - radius * cos_, zz, radius * sin_;
    return a;
  }

 private:
  Number zz_, upper_, lower_, cos_, sin_;
};

/// Space: Jacobi's rotations, in five sweeps, after which nothing but round-off is left off the diagonal (G. H. Golub
/// and C. F. Van Loan, Matrix Computations, 4th edition, section 8.5).
template <class Number>
class Principal<3, Number>
{
 public:
  explicit Principal(const SymmetricTensor<3, Number>& a) : a_(plane_part<3>(a)), axes_(Matrix<3, Number>::Zero())
  {
    for (int k = 0; k < 3; ++k) axes_(k, k) = Number(1.0);
    constexpr int n_sweeps = 5;
    for (int sweep = 0; sweep < n_sweeps; ++sweep) {
      rotate<0, 1>();
      rotate<0, 2>();
      rotate<1, 2>();
    }
    put_greater_first<0, 1>();
    put_greater_first<1, 2>();
    put_greater_first<0, 1>();
  }

  PrincipalValues<Number> values() const { return {a_(0, 0), a_(1, 1), a_(2, 2)}; }

  SymmetricTensor<3, Number> with(const PrincipalValues<Number>& v) const
  {
    Matrix<3, Number> scaled = axes_;
    for (int k = 0; k < 3; ++k) scaled.col(k) *= v[static_cast<std::size_t>(k)];
    return symmetric_part<3>(Matrix<3, Number>(scaled * axes_.transpose()));
  }

 private:
  /// Turns the axes p and q so that nothing is left between them.
  template <int p, int q>
  void rotate()
  {
    constexpr int r = 3 - p - q;
    const Number off = a_(p, q), difference = a_(q, q) - a_(p, p);
    // The smaller root of t^2 + 2 t cot(2 angle) - 1, without a division by what may be zero.
    const Number length = sqrt(difference * difference + 4.0 * off * off);
    const Number divisor = abs(difference) + length;
    const Number t =
        select(divisor > 0.0, 2.0 * select(difference < 0.0, -off, off) / select(divisor > 0.0, divisor, Number(1.0)),
               Number(0.0));
    const Number c = 1.0 / sqrt(1.0 + t * t), s = t * c;
    a_(p, p) -= t * off;
    a_(q, q) += t * off;
    a_(p, q) = a_(q, p) = Number(0.0);
    const Number rp = a_(r, p), rq = a_(r, q);
    a_(r, p) = a_(p, r) = c * rp - s * rq;
    a_(r, q) = a_(q, r) = s * rp + c * rq;
    for (int k = 0; k < 3; ++k) {
      const Number kp = axes_(k, p), kq = axes_(k, q);
      axes_(k, p) = c * kp - s * kq;
      axes_(k, q) = s * kp + c * kq;
    }
  }

  template <int p, int q>
  void put_greater_first()
  {
    const Mask<Number> wrong = a_(p, p) < a_(q, q);
    const auto exchange = [&](Number& one, Number& other) {
      const Number kept = one;
      one = select(wrong, other, one);
      other = select(wrong, kept, other);
    };
    exchange(a_(p, p), a_(q, q));
    for (int k = 0; k < 3; ++k) exchange(axes_(k, p), axes_(k, q));
  }

  Matrix<3, Number> a_, axes_;
};

}  // namespace tamp::components
