#pragma once

#include <algorithm>
#include <span>

#include "components/kinematics/polar_rotation.hpp"
#include "components/lanes.hpp"
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

/// The arithmetic of strain_increment(), for one particle or for as many as Number has lanes.
template <int D, class Number>
class StepOfDeformation
{
 public:
  StepOfDeformation(const Matrix<D, Number>& old_gradient, const Matrix<D, Number>& g)
  {
    const Matrix<D, Number> identity = Matrix<D, Number>::Identity();
    const Matrix<D, Number> f = identity + g, f_mid = identity + Number(0.5) * g;
    gradient_ = f * old_gradient;
    volume_ratio_ = f.determinant();
    mid_step_volume_ratio_ = f_mid.determinant();

    const Matrix<D, Number> rotation = polar_rotation(gradient_), old_rotation = polar_rotation(old_gradient);
    rotation_increment_ = rotation * old_rotation.transpose();
    defect_ = (rotation_increment_.transpose() * rotation_increment_ - identity).squaredNorm();
    // f without the rotations of its two ends: U_{n+1} U_n^-1.
    const Matrix<D, Number> stretching = rotation.transpose() * f * old_rotation;
    const Matrix<D, Number> rate = Number(2) * (stretching - identity) * (stretching + identity).inverse();
    const Matrix<D, Number> symmetric_rate = Number(0.5) * (rate + rate.transpose());
    strain_ = rotation * symmetric_rate * rotation.transpose();
  }

  /// False also if the rotation of that particle is not a number.
  template <class Pick>
  bool rotates_to_round_off(Pick pick) const
  {
    constexpr double round_off = 1e-13;
    return pick(defect_) < round_off * round_off;
  }

  /// That of one particle, whose number `pick` takes from a Number.
  template <class Pick>
  StrainIncrement<D> increment(Pick pick) const
  {
    StrainIncrement<D> step{gradient_.unaryExpr(pick), SymmetricTensor<D>::Zero(), Matrix<D>::Identity(),
                            pick(volume_ratio_), pick(mid_step_volume_ratio_)};
    if (!step.admissible()) return step;

    step.strain_increment = symmetric_part<D>(strain_.unaryExpr(pick));
    step.rotation_increment = rotation_increment_.unaryExpr(pick);
    return step;
  }

 private:
  Matrix<D, Number> gradient_, strain_, rotation_increment_;
  Number volume_ratio_, mid_step_volume_ratio_, defect_;
};

/// The matrices of up to n_lanes particles side by side; the identity where there is none.
template <int D>
Matrix<D, Lanes> lanes_of(std::span<const Matrix<D>> matrices)
{
  return Matrix<D, Lanes>::NullaryExpr([&](Eigen::Index row, Eigen::Index column) {
    return Lanes([&](std::size_t lane) {
      return lane < matrices.size() ? matrices[lane](row, column) : row == column ? 1.0 : 0.0;
    });
  });
}

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
  const auto itself = [](double x) { return x; };
  return StepOfDeformation<D, double>(deformation_gradient, g).increment(itself);
}

/// The same for many particles, as many at once as the processor has lanes, and one by one where stretches are more
/// than a thousand times apart. All spans have one length.
template <int D>
void strain_increments(std::span<const Matrix<D>> deformation_gradient, std::span<const Matrix<D>> g,
                       std::span<StrainIncrement<D>> increments)
{
  for (std::size_t first = 0; first < increments.size(); first += n_lanes) {
    const std::size_t size = std::min(n_lanes, increments.size() - first);
    const StepOfDeformation<D, Lanes> step(lanes_of<D>(deformation_gradient.subspan(first, size)),
                                           lanes_of<D>(g.subspan(first, size)));
    for (std::size_t lane = 0; lane < size; ++lane) {
      const auto pick = [lane](const Lanes& x) -> double { return x[lane]; };
      const std::size_t p = first + lane;
      increments[p] =
          step.rotates_to_round_off(pick) ? step.increment(pick) : strain_increment<D>(deformation_gradient[p], g[p]);
    }
  }
}

}  // namespace tamp::components
