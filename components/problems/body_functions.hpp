#pragma once

#include <functional>
#include <optional>

#include "components/geometry/polar_layout.hpp"
#include "components/materials/material_model.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// A body in functions: how it starts, what acts on it, how it moves then. X is where a point of the body is undeformed
/// [m], t the time [s]; in plane strain the third entries of vectors are 0, and that of a deformation gradient is 1.
/// Members may be empty. Functions are pure: they hold no state, and each rank and thread calls them for itself.
struct BodyFunctions {
  using Of = std::function<Vector<3>(const Vector<3>& X)>;
  using OfTime = std::function<Vector<3>(const Vector<3>& X, double t)>;

  /// Displacement at the start [m]. With it goes `deformation_gradient`, 1 + its gradient by X.
  Of displacement{};
  std::function<Matrix<3>(const Vector<3>& X)> deformation_gradient{};
  /// Velocity at the start [m/s].
  Of velocity{};
  /// Body force per mass [m/s^2].
  OfTime body_force{};
  /// Pressure on the surface, wherever that goes [Pa], compression positive. A node of the surface is pressed with the
  /// mean over
  /// the matter that it reaches.
  std::function<double(const Vector<3>& X, double t)> pressure{};
  /// Displacement by theory [m]; errors are measured against it.
  OfTime exact_displacement{};
  /// Whether the functions hold at X; without one they do everywhere.
  std::function<bool(const Vector<3>& X)> holds{};
  /// The particles' places; without one they are the sites of the lattice.
  std::optional<PolarLayout> layout{};
};

/// The body that a problem is set for.
struct ProblemBody {
  int dimension;
  /// Density of the undeformed material [kg/m^3].
  double density;
  const MaterialModel& material;
  bool axisymmetric = false;
};

}  // namespace tamp::components
