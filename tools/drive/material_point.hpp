#pragma once

#include <optional>
#include <string>

#include "tasks/scene.hpp"

namespace tamp::tools
{

/// A particle of a run by itself: it is deformed by what a person prescribes instead of by a grid.
struct MaterialPoint {
  Matrix<3> deformation_gradient;
  double volume = 1;                                      ///< over that at the start
  SymmetricTensor<3> stress{SymmetricTensor<3>::Zero()};  ///< Cauchy, tension positive, in the axes of space
  components::CapState state{};                           ///< of sand
  double bulk_modulus = 0;                                ///< Pa
  double shear_modulus = 0;                               ///< Pa
  double plastic_work = 0;                                ///< since the start, J per m3 of initial volume
  components::UpdateCounts last_update{};                 ///< of sand

  double pressure() const { return -trace(stress) / 3; }
  /// sqrt(J2), and the equivalent stress of von Mises, sqrt(3 J2).
  double sqrt_j2() const;
  double equivalent_stress() const;
};

/// Fresh material at rest: free of stress and strain at this deformation gradient, except that a neo-Hookean solid has
/// the stress that goes with it.
MaterialPoint fresh_point(const tasks::MaterialModel& material, const Matrix<3>& deformation_gradient);

/// Takes the point to a deformation gradient in one increment, as a step of a run does it. Where that fails the answer
/// says why, and the point must not be used any more.
std::optional<std::string> deform(const tasks::MaterialModel& material, const Matrix<3>& deformation_gradient,
                                  MaterialPoint& point);

/// How far the stress is outside of the yield surface, over the length of the surface, crush pressure less tension
/// vertex; 0 inside.
double outside(const components::TabularCap& sand, const MaterialPoint& point);

}  // namespace tamp::tools
