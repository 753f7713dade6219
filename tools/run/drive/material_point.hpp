#pragma once

#include <any>
#include <optional>
#include <string>

#include "components/materials/invariants.hpp"
#include "tasks/scene.hpp"

namespace tamp::tools
{

/// A particle of a run by itself: it is deformed by what a person prescribes instead of by a grid.
struct MaterialPoint {
  Matrix<3> deformation_gradient;
  double volume = 1;                                      ///< over that at the start
  SymmetricTensor<3> stress{SymmetricTensor<3>::Zero()};  ///< Cauchy, tension positive, in the axes of space
  std::any state{};                                       ///< the `State` of its model
  double bulk_modulus = 0;                                ///< Pa
  double shear_modulus = 0;                               ///< Pa
  double opening = 0;                                     ///< gaps between grains, as a volumetric strain
  double plastic_work = 0;                                ///< since the start, J per m3 of initial volume
  components::UpdateCounts last_update{};

  components::Invariants invariants() const { return components::invariants(stress); }
};

/// Fresh material at this deformation gradient, with the stress that its model gives it for no further strain.
MaterialPoint fresh_point(const tasks::MaterialModel& material, const Matrix<3>& deformation_gradient);

/// Takes the point to a deformation gradient in one increment, as a step of a run does it. Where that fails the answer
/// says why, and the point must not be used any more.
std::optional<std::string> deform(const tasks::MaterialModel& material, const Matrix<3>& deformation_gradient,
                                  MaterialPoint& point);

}  // namespace tamp::tools
