#pragma once

#include <string_view>

#include "components/lanes.hpp"
#include "components/portable_math.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// det (1 + g) - 1, without the round-off of that difference.
template <int D, class Number>
Number volume_change_of(const Matrix<D, Number>& g)
{
  const auto minor = [&g](int i, int k) { return g(i, i) * g(k, k) - g(i, k) * g(k, i); };
  if constexpr (D == 2) {
    return g(0, 0) + g(1, 1) + minor(0, 1);
  } else {
    return g(0, 0) + g(1, 1) + g(2, 2) + (minor(0, 1) + minor(1, 2) + minor(0, 2)) + g.determinant();
  }
}

/// The strain of a step of f between the rotations of its two ends, in the axes of space at its end. Freed of them, f
/// is the stretching S = R_{n+1}^T f R_n = U_{n+1} U_n^-1; its rate, read at the middle of the step, is
/// 2 (S - I) (S + I)^-1, of which the strain is the symmetric part.
template <int D, class Number>
SymmetricTensor<D, Number> strain_between(const Matrix<D, Number>& f, const Matrix<D, Number>& old_rotation,
                                          const Matrix<D, Number>& rotation)
{
  const Matrix<D, Number> identity = Matrix<D, Number>::Identity();
  const Matrix<D, Number> stretching = rotation.transpose() * f * old_rotation;
  const Matrix<D, Number> rate = Number(2) * (stretching - identity) * (stretching + identity).inverse();
  const Matrix<D, Number> symmetric_rate = Number(0.5) * (rate + rate.transpose());
  return symmetric_part<D>(rotation * symmetric_rate * rotation.transpose());
}

/// f = 1 + g: just what the increments v dt of the positions do to a neighbourhood. An update is made of the functions
/// below, of a number that may be Lanes.
struct ExactUpdate {
  static constexpr std::string_view word = "exact";
  static constexpr std::string_view meaning = "by 1 + g, with a strain free of rotations";
  /// Whether a step that is too large turns a particle inside out, or else turns it further than the update can follow.
  static constexpr bool inverts = true;

  /// f, which takes F from the start of the step to its end.
  template <int D, class Number>
  static Matrix<D, Number> map(const Matrix<D, Number>& g)
  {
    return Matrix<D, Number>::Identity() + g;
  }

  template <int D, class Number>
  static Number volume_ratio(const Matrix<D, Number>& f, const Matrix<D, Number>&)
  {
    return f.determinant();
  }
  /// Not above 0 where the step is too large for the update.
  template <int D, class Number>
  static Number mid_step_volume_ratio(const Matrix<D, Number>& g)
  {
    const Matrix<D, Number> f_mid = Matrix<D, Number>::Identity() + Number(0.5) * g;
    return f_mid.determinant();
  }

  template <int D, class Number>
  static SymmetricTensor<D, Number> strain(const Matrix<D, Number>& f, const Matrix<D, Number>&,
                                           const Matrix<D, Number>& old_rotation, const Matrix<D, Number>& rotation)
  {
    return strain_between<D, Number>(f, old_rotation, rotation);
  }

  /// The ratio by which a line is stretched that does not turn, as the hoop of a ring, and its strain.
  template <class Number>
  static Number stretch(const Number& g)
  {
    return 1.0 + g;
  }
  template <class Number>
  static Number stretch_strain(const Number& g)
  {
    return g / (1.0 + 0.5 * g);
  }

  /// det f - 1.
  template <int D, class Number>
  static Number volume_change(const Matrix<D, Number>& g)
  {
    return volume_change_of<D, Number>(g);
  }
  /// The g whose f is as that of `g`, but stretched alike in all directions, so that its volume change is `change`. As
  /// it is where the volume has no ratio.
  template <int D, class Number>
  static Matrix<D, Number> with_volume_change(const Matrix<D, Number>& g, const Number& change)
  {
    const Number own = volume_change<D, Number>(g), ratio_less_one = (change - own) / (1.0 + own);
    const Number stretch = portable::expm1(portable::log1p(ratio_less_one) / Number(D));
    const Number stretch_less_one = select(own > -1.0 && change > -1.0, stretch, Number(0.0));
    return g + stretch_less_one * (Matrix<D, Number>::Identity() + g);
  }
};

}  // namespace tamp::components
