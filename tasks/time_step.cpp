#include "tasks/time_step.hpp"

#include <algorithm>
#include <initializer_list>

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
  const auto add = [&](const runtime::Label& label) {
    const bool is_new = std::find(data.state.begin(), data.state.end(), &label) == data.state.end();
    if (is_new) data.state.push_back(&label);
  };
  std::visit(
      [&]<class Model>(const Model& of_material) {
        if constexpr (components::has_state<Model>) add(particle::state<Model>);
        if (components::keeps_gaps(of_material)) add(particle::opening);
      },
      model);
}

/// Tasks, and the name under which a trace shows them together.
struct Phase {
  const char* name;
  runtime::TaskList tasks;
};

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
  const bool computes_inverse_mass = method.stress_timing == StressTiming::usl;
  const std::initializer_list<Phase> phases{{"stress", update_stress_first(method)},
                                            {"stress", share_stress(method)},
                                            {"particles to grid", particles_to_grid(method)},
                                            {"loads", press(method)},
                                            {"loads", body_force(method)},
                                            {"motion of nodes", accelerate_nodes(method, computes_inverse_mass)},
                                            {"rigid bodies", accelerate_rigid_bodies(method)},
                                            {"rigid bodies", rigid_nodes_before_contact(method)},
                                            {"contact", contact_planes(method)},
                                            {"rigid bodies", gather_rigid_contact(method)},
                                            {"rigid bodies", gather_contact_of_solids(method)},
                                            {"rigid bodies", rigid_nodes_after_contact(method)},
                                            {"contact", contact(method)},
                                            {"contact", contact_of_solids(method)},
                                            {"walls", find_wall_gaps(method)},
                                            {"walls", walls(method)},
                                            {"loads", account_for_pressure(method)},
                                            {"rigid bodies", move_rigid_bodies(method)},
                                            {"rigid bodies", move_rigid_particles(method)},
                                            {"motion of nodes", pass_velocities(method)},
                                            {"grid to particles", grid_to_particles(method)},
                                            {"loads", work_of_body_force(method)},
                                            {"stress", update_stress_last(method)},
                                            {"accounts", count_lost(method)},
                                            {"accounts", account_for_step(method)},
                                            {"migration", {migrate(method)}}};
  runtime::TaskList step;
  for (const Phase& phase : phases) {
    const auto first = step.insert(step.end(), phase.tasks.begin(), phase.tasks.end());
    for (auto task = first; task != step.end(); ++task) task->phase = phase.name;
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
                          &step_records,
                          &refused_steps,
                          &monitor_records},
                         {}};
  if (!method.deformable_materials.empty()) data.results.push_back(&null_space_motion);
  for (const SceneMaterial& material : method.materials) add_state_of(material.model, data);
  if (method.scene.is_periodic()) data.state.push_back(&particle::laps);
  if (method.axisymmetric) data.state.push_back(&particle::hoop_stretch);
  if (method.brings_gradients()) data.state.push_back(&particle::velocity_gradient<D>);
  if (method.brings_moments()) data.state.push_back(&particle::velocity_moment<D>);
  return data;
}

template runtime::TaskList time_step(const Method<2>&);
template runtime::TaskList time_step(const Method<3>&);
template runtime::HostData host_data(const Method<2>&);
template runtime::HostData host_data(const Method<3>&);

}  // namespace tamp::tasks
