#include "tasks/time_step.hpp"

#include <algorithm>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

using components::Surroundings;

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

/// On every patch, with particles or without, so that every rank that has one is heard.
runtime::TaskDeclaration hear_hosts()
{
  return runtime::task("hear hosts")
      .over_patches()
      .reduces(host_requests)
      .body([](const runtime::TaskContext& at, auto data) { data[host_requests].bits = at.step.host_requests; });
}

/// Particles deform, where moving them has not done that, and their materials answer.
template <int D>
void add_stress(const Method<D>& method, std::vector<runtime::TaskDeclaration>& step)
{
  if (method.deformable_materials.empty()) return;
  if (method.stress_timing != StressTiming::usl) {
    for (runtime::TaskDeclaration& phase : deform_by_carried_velocities(method)) step.push_back(std::move(phase));
  }
  if (method.deforms_as_cells()) step.push_back(deform_as_cells(method));
  for (const int material : method.deformable_materials) step.push_back(update_stress(method, material));
}

}  // namespace

template <int D>
std::vector<runtime::TaskDeclaration> time_step(const Method<D>& method,
                                                std::function<bool(const StepTotals&)> accepted)
{
  std::vector<runtime::TaskDeclaration> step;
  step.push_back(hear_hosts());
  if (method.stress_timing == StressTiming::usf) add_stress(method, step);
  if (method.deforms_as_cells()) {
    for (runtime::TaskDeclaration& phase : share_stress(method)) step.push_back(std::move(phase));
  }
  for (runtime::TaskDeclaration& phase : particles_to_grid(method)) step.push_back(std::move(phase));
  if (!method.pressed_materials.empty()) {
    for (runtime::TaskDeclaration& phase : press(method)) step.push_back(std::move(phase));
  }
  if (method.scene.has_body_force()) step.push_back(body_force(method));
  if (!method.deformable_materials.empty()) step.push_back(accelerate_nodes(method));
  if (!method.rigid_bodies.empty()) step.push_back(accelerate_rigid_bodies(method));
  for (const RigidBody& body : method.rigid_bodies) step.push_back(rigid_nodes_before_contact(method, body.material));
  if (method.contacts.has_regression()) {
    for (runtime::TaskDeclaration& phase : contact_planes(method)) step.push_back(std::move(phase));
  }
  if (!method.rigid_bodies.empty()) {
    step.push_back(gather_rigid_contact(method));
    step.push_back(rigid_nodes_after_contact(method));
  }
  step.push_back(contact(method));
  step.push_back(walls(method));
  if (!method.pressed_materials.empty()) step.push_back(account_for_pressure(method));
  if (!method.rigid_bodies.empty()) step.push_back(move_rigid_bodies(method));
  for (const RigidBody& body : method.rigid_bodies) step.push_back(move_rigid_particles(method, body.material));
  for (runtime::TaskDeclaration& phase : pass_velocities(method)) step.push_back(std::move(phase));
  if (!method.deformable_materials.empty()) step.push_back(grid_to_particles(method));
  if (method.scene.has_body_force()) step.push_back(work_of_body_force(method));
  if (method.stress_timing != StressTiming::usf) add_stress(method, step);
  step.push_back(runtime::migration(particle::position<D>, step_totals, std::move(accepted),
                                    method.scene.is_periodic() ? &particle::laps : nullptr));
  return step;
}

template <int D>
runtime::HostData host_data(const Method<D>& method)
{
  runtime::HostData data{{&particle::id, &particle::body, &particle::reference_position<D>, &particle::mass,
                          &particle::position<D>, &particle::velocity<D>, &particle::deformation_gradient<D>,
                          &particle::volume, &particle::stress<D>, &particle::viscous_pressure, &rigid_states},
                         {&step_totals, &grid_totals, &contact_impulses, &host_requests}};
  for (const SceneMaterial& material : method.materials) add_state_of(material.model, data);
  if (!method.pressed_materials.empty()) data.results.push_back(&load_totals);
  if (method.scene.is_periodic()) data.state.push_back(&particle::laps);
  if (method.surroundings == Surroundings::gradient) data.state.push_back(&particle::velocity_gradient<D>);
  if (method.surroundings == Surroundings::moment) data.state.push_back(&particle::velocity_moment<D>);
  if (method.scene.has_body_force()) data.results.push_back(&body_force_work);
  return data;
}

template std::vector<runtime::TaskDeclaration> time_step(const Method<2>&, std::function<bool(const StepTotals&)>);
template std::vector<runtime::TaskDeclaration> time_step(const Method<3>&, std::function<bool(const StepTotals&)>);
template runtime::HostData host_data(const Method<2>&);
template runtime::HostData host_data(const Method<3>&);

}  // namespace tamp::tasks
