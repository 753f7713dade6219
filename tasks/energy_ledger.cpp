#include "tasks/energy_ledger.hpp"

namespace tamp::tasks
{

void EnergyLedger::add(const StepTotals& step, const GridTotals& nodes, const BodyForceWork& body_forces,
                       const LoadTotals& loads, bool deforms_by_other_velocities)
{
  gained += nodes.gained_by_particles + nodes.gained_by_rigid_bodies;
  elastic += step.elastic;
  plastic += step.plastic;
  viscous += step.viscous + nodes.taken_by_damping;
  contact += step.contact + nodes.taken_by_walls;
  last_driving = step.driving + loads.work;
  driving += last_driving + body_forces.value;
  gravity += nodes.gravity_work;
  gravity_at_end = nodes.gravity_work_at_end;
  add_filtered(step, nodes, body_forces, loads, deforms_by_other_velocities);
}

void EnergyLedger::add_filtered(const StepTotals& step, const GridTotals& nodes, const BodyForceWork& body_forces,
                                const LoadTotals& loads, bool deforms_by_other_velocities)
{
  filter += nodes.gained_by_nodes - nodes.gained_by_particles;
  if (deforms_by_other_velocities) {
    // Stress works at other velocities than those of the nodes that its forces work on.
    filter += nodes.taken_by_forces + loads.work + body_forces.value - (step.elastic + step.plastic + step.viscous);
    return;
  }
  // At the start of a step forces take from the velocities that particles bring, which are not those of the end of the
  // step before. Body forces work on particles as stress does; loads work on nodes, where nothing is filtered out.
  filter += nodes.taken_by_forces + loads.work_at_start - half_step;
  half_step = step.stress_work_at_end - body_forces.at_end;
}

}  // namespace tamp::tasks
