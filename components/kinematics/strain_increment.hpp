#pragma once

#include "components/kinematics/exact_update.hpp"
#include "components/kinematics/polar_rotation.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The change of a particle's deformation in one step. Strains are logarithmic-like: rates of deformation integrated in
/// the particle's own rotating frame, then turned to the axes of space; tension positive. Where Number is Lanes it is
/// that of as many particles.
template <int D, class Number = double>
struct StrainIncrement {
  /// F at the end of the step.
  Matrix<D, Number> deformation_gradient;
  /// D dt in the axes of space at the end of the step; in plane strain its zz is 0.
  SymmetricTensor<D, Number> strain_increment;
  /// R_{n+1} R_n^T: `rotated(old, rotation_increment)` carries a stress or strain of the start of the step to its end.
  Matrix<D, Number> rotation_increment;
  /// det f and det (I + g/2): volume at the end and at the middle of the step over the volume at its start.
  Number volume_ratio;
  Number mid_step_volume_ratio;

  /// False if the step turns the particle inside out, makes it half a turn or more, or is not a number. The strain is
  /// then 0, the rotation increment the identity, and the step must not be used.
  Mask<Number> admissible() const { return volume_ratio > 0.0 && mid_step_volume_ratio > 0.0; }
  /// False if the rotation is not orthogonal to round-off, or is not a number.
  Mask<Number> rotates_to_round_off() const
  {
    constexpr double round_off = 1e-13;
    const Matrix<D, Number> defect = rotation_increment.transpose() * rotation_increment;
    return (defect - Matrix<D, Number>::Identity()).squaredNorm() < round_off * round_off;
  }
};

/// The arithmetic of strain_increment(), for one particle or for as many as Number has lanes. Of Lanes some may be off
/// where stretches are more than a thousand times apart: the caller has to see which are `admissible` and which
/// `rotates_to_round_off`.
template <int D, class Number, class Update = ExactUpdate>
[[gnu::flatten]] StrainIncrement<D, Number> unchecked_increment(const Matrix<D, Number>& old_gradient,
                                                                const Matrix<D, Number>& g)
{
  const Matrix<D, Number> f = Update::template map<D, Number>(g);
  StrainIncrement<D, Number> step;
  step.deformation_gradient = f * old_gradient;
  step.volume_ratio = Update::template volume_ratio<D, Number>(f, g);
  step.mid_step_volume_ratio = Update::template mid_step_volume_ratio<D, Number>(g);

  const auto [old_rotation, rotation] = polar_rotations(old_gradient, step.deformation_gradient);
  step.rotation_increment = rotation * old_rotation.transpose();
  step.strain_increment = Update::template strain<D, Number>(f, g, old_rotation, rotation);
  return step;
}

/// The deformation from F_n by g = dt sum_i v_i (x) grad S_ip, v_i the mid-step node velocities, so that the increment
/// of the positions is v dt with nothing left out (Banerjee, Brannon, Fox, Regueiro, PAR-10021867-092020-6, eqs 54-57).
/// Row of g: component of velocity; column: direction of the gradient. det F_n must be above 0.
///
/// A rotation laid over the motion, however large and however fast, leaves the stretching S as it is (see
/// strain_between): with the exact update the increment is objective to round-off, and second order in dt. (With the
/// rate of f itself at mid-step, as T. J. R. Hughes and J. Winget have it, Int. J. Numer. Meth. Eng. 15, 1980, it would
/// be objective for rigid motions only.)
template <int D, class Update = ExactUpdate>
StrainIncrement<D> strain_increment(const Matrix<D>& deformation_gradient, const Matrix<D>& g)
{
  StrainIncrement<D> step = unchecked_increment<D, double, Update>(deformation_gradient, g);
  if (step.admissible()) return step;
  step.strain_increment.setZero();
  step.rotation_increment.setIdentity();
  return step;
}

}  // namespace tamp::components
