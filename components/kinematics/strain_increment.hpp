#pragma once

#include "components/kinematics/polar_rotation.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// What one step does to a particle's deformation. Strains are logarithmic-like: rates of deformation integrated in
/// the particle's own rotating frame, then turned to the axes of space; tension positive.
template <int D>
struct StrainIncrement {
  /// F at the end of the step.
  Matrix<D> deformation_gradient;
  /// D dt in the axes of space at the end of the step; in plane strain its zz is 0.
  SymmetricTensor<D> strain_increment;
  /// R_{n+1} R_n^T: `rotated(old, rotation_increment)` carries a stress or strain of the start of the step to its end.
  Matrix<D> rotation_increment;
  /// det f and det (I + g/2): volume at the end and at the middle of the step over the volume at its start.
  double volume_ratio;
  double mid_step_volume_ratio;

  /// False if the step turns the particle inside out, makes it half a turn or more, or is not a number. The strain is
  /// then 0, the rotation increment the identity, and the step must not be used.
  bool admissible() const { return volume_ratio > 0 && mid_step_volume_ratio > 0; }
};

/// The deformation from F_n by g = dt sum_i v_i (x) grad S_ip, v_i the mid-step node velocities, so that the increment
/// of the positions is v dt with nothing left out (Banerjee, Brannon, Fox, Regueiro, PAR-10021867-092020-6, eqs 54-57).
/// Row of g: component of velocity; column: direction of the gradient. det F_n must be above 0.
///
/// Freed of the rotations of its two ends, f is the stretching S = R_{n+1}^T f R_n = U_{n+1} U_n^-1. Its rate, read at
/// the middle of the step, is 2 (S - I) (S + I)^-1; the strain increment is the symmetric part of that, turned to the
/// end of the step. A rotation laid over the motion, however large and however fast, leaves S as it is: the increment
/// is objective to round-off, and second order in dt. (With the rate of f itself at mid-step, as T. J. R. Hughes and J.
/// Winget have it, Int. J. Numer. Meth. Eng. 15, 1980, it would be objective for rigid motions only.)
template <int D>
StrainIncrement<D> strain_increment(const Matrix<D>& deformation_gradient, const Matrix<D>& g)
{
  const Matrix<D> identity = Matrix<D>::Identity();
  const Matrix<D> f = identity + g, f_mid = identity + 0.5 * g;
  StrainIncrement<D> step{f * deformation_gradient, SymmetricTensor<D>::Zero(), identity, f.determinant(),
                          f_mid.determinant()};
  if (!step.admissible()) return step;

  const Matrix<D> rotation = polar_rotation(step.deformation_gradient),
                  old_rotation = polar_rotation(deformation_gradient);
  step.rotation_increment = rotation * old_rotation.transpose();
  // f without the rotations of its two ends: U_{n+1} U_n^-1.
  const Matrix<D> stretching = rotation.transpose() * f * old_rotation;
  const Matrix<D> rate = 2 * (stretching - identity) * (stretching + identity).inverse();
  step.strain_increment = rotated<D>(symmetric_part<D>(rate), rotation);
  return step;
}

}  // namespace tamp::components
