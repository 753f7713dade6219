#pragma once

#include "components/materials/material_batch.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// Whether bodies of this material may start deformed: its stress follows from the deformation gradient alone.
bool may_start_deformed(const MaterialModel& model);

/// The state of a body that starts deformed, at a point.
template <int D>
struct DeformedStart {
  Matrix<D> deformation_gradient;
  double volume_ratio;        ///< its determinant, in axisymmetric scenes times the stretch of the hoop
  SymmetricTensor<D> stress;  ///< Cauchy [Pa]
  double stored_energy;       ///< J per m^3 of the undeformed material
  components::TangentModuli moduli;
};

/// At X, of a body whose functions give the deformation gradient and whose material allows it.
template <int D>
DeformedStart<D> deformed_start(const Scene& scene, const SceneBody& body, const Vector<D>& X);

/// The greatest moduli of such a body [Pa], as of material with its undeformed density: J times the tangent ones, so
/// that they give its wave speeds.
template <int D>
components::TangentModuli greatest_deformed_moduli(const Scene& scene, const SceneBody& body);

}  // namespace tamp::tasks
