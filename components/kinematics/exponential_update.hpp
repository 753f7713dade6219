#pragma once

#include <numbers>
#include <string_view>

#include "components/kinematics/exact_update.hpp"

namespace tamp::components
{

/// exp(a) by its series to the twelfth power of a / 8, squared three times: to round-off while |a| is below pi. Without
/// a branch.
template <int D, class Number>
Matrix<D, Number> exponential_of(const Matrix<D, Number>& a)
{
  constexpr int order = 12, n_squarings = 3;
  const Matrix<D, Number> identity = Matrix<D, Number>::Identity(), part = Number(0.125) * a;
  Matrix<D, Number> sum = identity;
  for (int k = order; k > 0; --k) sum = identity + Number(1.0 / k) * (part * sum).eval();
  for (int k = 0; k < n_squarings; ++k) sum = (sum * sum).eval();
  return sum;
}

/// f = exp(g): the flow of a velocity gradient that is constant within the step. The volume ratio is exp(tr g) and the
/// trace of the strain is tr g, so that no step turns a particle inside out. As g is taken over the shape at the start
/// of the step, particles drift from where their deformations have them by |g|^2 / 2 a step.
struct ExponentialUpdate {
  static constexpr std::string_view word = "exponential";
  static constexpr std::string_view meaning = "by exp(g), which turns nothing inside out";
  static constexpr bool inverts = false;

  template <int D, class Number>
  static Matrix<D, Number> map(const Matrix<D, Number>& g)
  {
    const Number mean = g.trace() / Number(D);
    return portable::exp(mean) * exponential_of<D, Number>(without_trace<D, Number>(g));
  }

  template <int D, class Number>
  static Number volume_ratio(const Matrix<D, Number>&, const Matrix<D, Number>& g)
  {
    return portable::exp(Number(g.trace()));
  }
  template <int D, class Number>
  static Number mid_step_volume_ratio(const Matrix<D, Number>& g)
  {
    constexpr double farthest = std::numbers::pi * std::numbers::pi;
    const Number size = without_trace<D, Number>(g).squaredNorm();
    return select(size < farthest, portable::exp(Number(0.5) * g.trace()), Number(0.0));
  }

  template <int D, class Number>
  static SymmetricTensor<D, Number> strain(const Matrix<D, Number>& f, const Matrix<D, Number>& g,
                                           const Matrix<D, Number>& old_rotation, const Matrix<D, Number>& rotation)
  {
    SymmetricTensor<D, Number> strain = strain_between<D, Number>(f, old_rotation, rotation);
    const Number missing = (Number(g.trace()) - trace(strain)) / Number(D);
    for (int i = 0; i < D; ++i) strain[i] += missing;
    return strain;
  }

  template <class Number>
  static Number stretch(const Number& g)
  {
    return portable::exp(g);
  }
  template <class Number>
  static Number stretch_strain(const Number& g)
  {
    return g;
  }

  template <int D, class Number>
  static Number volume_change(const Matrix<D, Number>& g)
  {
    return portable::expm1(Number(g.trace()));
  }
  template <int D, class Number>
  static Matrix<D, Number> with_volume_change(const Matrix<D, Number>& g, const Number& change)
  {
    const Number missing = (portable::log1p(change) - Number(g.trace())) / Number(D);
    return g + select(change > -1.0, missing, Number(0.0)) * Matrix<D, Number>::Identity();
  }

 private:
  template <int D, class Number>
  static Matrix<D, Number> without_trace(const Matrix<D, Number>& g)
  {
    return g - g.trace() / Number(D) * Matrix<D, Number>::Identity();
  }
};

}  // namespace tamp::components
