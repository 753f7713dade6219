#pragma once

#include "tasks/step_totals.hpp"

namespace tamp::tasks
{

/// Where the energy of a simulation has gone since its start, and what has come from outside [J]. Particles that leave
/// the domain stay in it. The sum of all stays the same, but for the error of the steps: see `sum`.
struct EnergyLedger {
  /// Kinetic energy gained since the start.
  double gained = 0;
  double elastic = 0;
  double plastic = 0;
  double viscous = 0;  ///< by artificial viscosity and local damping
  double contact = 0;  ///< by friction and impact between bodies and at walls
  /// Energy that particles have filtered out of the motion of the nodes: what nodes gain and their particles do not,
  /// and what forces take at velocities other than those at which their work is counted.
  double filter = 0;
  /// Work of driven bodies, body forces and pressure loads.
  double driving = 0;
  /// The part of `driving` that driven bodies and pressure loads did in the last step.
  double last_driving = 0;
  /// Work of gravity and of a steady centrifuge.
  double gravity = 0;
  /// Work of stress in the second half of the last step, taken from the motion, less that of body forces. Velocities
  /// are half a step behind all else, so that kinetic energy still has it. 0 where particles deform by other
  /// velocities.
  double half_step = 0;
  /// Work of gravity in the second half of the last step.
  double gravity_at_end = 0;

  /// Work from outside.
  double external() const { return gravity + driving; }
  /// Energy gained, stored and dissipated, less what came from outside; at the start it is `elastic`.
  double sum() const
  {
    return gained + elastic + plastic + viscous + contact + filter - (half_step - gravity_at_end) - external();
  }

  /// Adds a step. Totals of what a scene does not have are those of nothing. `deforms_by_other_velocities`: see Method.
  void add(const StepTotals& step, const GridTotals& nodes, const BodyForceWork& body_forces, const LoadTotals& loads,
           bool deforms_by_other_velocities);

 private:
  void add_filtered(const StepTotals& step, const GridTotals& nodes, const BodyForceWork& body_forces,
                    const LoadTotals& loads, bool deforms_by_other_velocities);
};

}  // namespace tamp::tasks
