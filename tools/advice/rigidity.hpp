#pragma once

#include "tools/advice/penetration.hpp"

namespace tamp::tools
{

/// The change in depth of a body that goes into softer ground where it is made rigid. Read from runs of the punch whose
/// modulus, mass, length, speed, cells and sand were varied, see docs/findings/rigid_or_deformable.md.
struct Rigidity {
  /// Strain of the body where the ground's waves press on it: rho c v of the ground over the body's modulus.
  double strain;
  /// The time that a wave takes through the body, over the simulated time.
  double transit;
  /// The part of its way that the ground takes from the body by the end.
  double slowed;
  /// Cells to the half width: on few of them a surface that is rigid differs from one of particles, however stiff.
  double cells;

  /// Relative change of the depth at the end.
  double depth_error() const { return slowed * (0.2 / cells + 0.1 * transit); }
  /// Within 1 % of the deformable body's depth. A body that is strained by more is off by more than the above.
  bool is_safe() const { return !is_soft() && depth_error() <= 0.01; }
  bool is_soft() const { return strain >= 0.05; }
};

/// The rigidity of a body on its way into another one, by its material's moduli, also where it is rigid already.
Rigidity rigidity_of(const tasks::Scene& scene, const tasks::SceneBody& body, const Penetration& penetration);

}  // namespace tamp::tools
