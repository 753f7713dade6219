#include "tasks/time_step.hpp"

#include <algorithm>

#include "runtime/graph/step_verdict.hpp"
#include "tasks/labels.hpp"
#include "tasks/monitors.hpp"
#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

namespace
{

void add_state_of(const MaterialModel& model, runtime::HostData& data)
{
  std::visit(
      [&]<class Model>(const Model&) {
        if constexpr (components::has_state<Model>) {
          const runtime::Label* const label = &particle::state<Model>;
          const bool is_new = std::find(data.state.begin(), data.state.end(), label) == data.state.end();
          if (is_new) data.state.push_back(label);
        }
      },
      model);
}

/// At the end of a step that is not refused particles go to the patches that they are in by then.
template <int D>
runtime::TaskDeclaration migrate(const Method<D>& method)
{
  return runtime::migration(particle::position<D>, runtime::step_verdict,
                            method.scene.is_periodic() ? &particle::laps : nullptr);
}

}  // namespace

template <int D>
runtime::TaskList time_step(const Method<D>& method)
{
  // Where particles deform by other velocities, what they bring of these tells the masses too.
  const bool tells_masses = method.stress_timing == StressTiming::usl;
  runtime::TaskList step;
  for (const runtime::TaskList& phase : {update_stress_first(method),
                                         share_stress(method),
                                         particles_to_grid(method),
                                         press(method),
                                         body_force(method),
                                         accelerate_nodes(method, tells_masses),
                                         accelerate_rigid_bodies(method),
                                         rigid_nodes_before_contact(method),
                                         contact_planes(method),
                                         gather_rigid_contact(method),
                                         rigid_nodes_after_contact(method),
                                         contact(method),
                                         walls(method),
                                         account_for_pressure(method),
                                         move_rigid_bodies(method),
                                         move_rigid_particles(method),
                                         pass_velocities(method),
                                         grid_to_particles(method),
                                         work_of_body_force(method),
                                         update_stress_last(method),
                                         count_lost(method),
                                         account_for_step(method),
                                         runtime::TaskList{migrate(method)}}) {
    step.insert(step.end(), phase.begin(), phase.end());
  }
  return step;
}

template <int D>
runtime::HostData host_data(const Method<D>& method)
{
  runtime::HostData data{{&particle::id,
                          &particle::body,
                          &particle::reference_position<D>,
                          &particle::mass,
                          &particle::position<D>,
                          &particle::velocity<D>,
                          &particle::deformation_gradient<D>,
                          &particle::volume,
                          &particle::stress<D>,
                          &particle::viscous_pressure,
                          &rigid_states,
                          &step_totals,
                          &grid_totals,
                          &lost_particles,
                          &contact_impulses,
                          &load_totals,
                          &forces_taken_at,
                          &energy_ledger,
                          &longest_step,
                          &refused_steps,
                          &monitor_records},
                         {}};
  if (!method.deformable_materials.empty()) data.results.push_back(&unseen_motion);
  for (const SceneMaterial& material : method.materials) add_state_of(material.model, data);
  if (method.scene.is_periodic()) data.state.push_back(&particle::laps);
  if (method.brings_gradients()) data.state.push_back(&particle::velocity_gradient<D>);
  if (method.brings_moments()) data.state.push_back(&particle::velocity_moment<D>);
  return data;
}

template runtime::TaskList time_step(const Method<2>&);
template runtime::TaskList time_step(const Method<3>&);
template runtime::HostData host_data(const Method<2>&);
template runtime::HostData host_data(const Method<3>&);

}  // namespace tamp::tasks
