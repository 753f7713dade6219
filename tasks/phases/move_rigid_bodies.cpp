#include <algorithm>

#include "components/loads/time_step.hpp"
#include "tasks/labels.hpp"
#include "tasks/particle_axes.hpp"
#include "tasks/phases/gravity_work.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

/// Accelerates rigid bodies by body forces, in the leapfrog of `accelerate_nodes`.
template <int D>
runtime::TaskList accelerate_rigid_bodies(const Method<D>& method)
{
  if (method.rigid_bodies.empty()) return {};
  return {runtime::task("accelerate rigid bodies")
              .over_ranks()
              .reads(rigid_states.previous())
              .computes(free_rigid_states)
              .body([&method](const TaskContext& at, auto data) {
                const RigidStates& before = data[rigid_states.previous()];
                RigidStates& free = data[free_rigid_states];
                const double kick = 0.5 * (at.step.previous_size + at.step.size);
                for (const RigidBody& body : method.rigid_bodies) {
                  components::RigidState& state = free.of(body);
                  state = at_rest_across_mirrors(
                      body, accelerated(body.properties, before.of(body), in_space<D>(method.gravity),
                                        method.centrifuge, at.step.time, kick));
                  if (body.drive == nullptr) continue;
                  const Eigen::Vector3d undriven = state.momentum;
                  state = driven(body.properties, *body.drive, state, at.step.time, at.step.size);
                  free.driving[static_cast<std::size_t>(body.material)] = state.momentum - undriven;
                }
              })};
}

template <int D>
runtime::TaskList move_rigid_bodies(const Method<D>& method)
{
  if (method.rigid_bodies.empty()) return {};
  return {runtime::task("move rigid bodies")
              .over_ranks()
              .reads(free_rigid_states, contact_impulses)
              .computes(rigid_states)
              .body([&method](const TaskContext& at, auto data) {
                const RigidStates& free = data[free_rigid_states];
                const ContactImpulses& impulses = data[contact_impulses];
                RigidStates& after = data[rigid_states];
                for (const RigidBody& body : method.rigid_bodies) {
                  const auto g = static_cast<std::size_t>(body.material);
                  after.of(body) =
                      moved(body.properties, free.of(body), impulses.by_material[g], body.held(), at.step.size);
                  after.driving[g] = free.driving[g] - impulses.by_material[g].linear;
                }
              })};
}

namespace
{

/// Adds the momentum and work given to the body as a whole in the step, on one patch. The work of driving goes with the
/// mean of the velocities before and after, as the energies of leapfrog are counted.
void add_totals(const TaskContext& at, const RigidBody& body, const RigidStates& before, const RigidStates& after,
                GridTotals& grid, StepTotals& totals)
{
  if (at.patch.id != 0) return;
  const Eigen::Vector3d p = before.of(body).momentum, q = after.of(body).momentum;
  for (int k = 0; k < 3; ++k) grid.impulse[static_cast<std::size_t>(k)] += q[k] - p[k];
  grid.gained_by_rigid_bodies += components::kinetic_energy(body.properties, after.of(body)) -
                                 components::kinetic_energy(body.properties, before.of(body));
  if (body.drive == nullptr) return;
  totals.driving += after.driving[static_cast<std::size_t>(body.material)].dot(p + q) / (2 * body.properties.mass);
}

/// Positions of the points of a rigid body in a state of it.
template <int D>
struct Placement {
  Placement(const RigidBody& body, const components::RigidState& state)
      : turn(state.orientation.toRotationMatrix().template topLeftCorner<D, D>()),
        start(body.properties.centre.template head<D>()),
        centre(state.centre.template head<D>())
  {
  }

  Vector<D> operator()(const Vector<D>& reference) const { return centre + turn * (reference - start); }

  Matrix<D> turn;
  Vector<D> start, centre;
};

}  // namespace

/// A rigid body's particles keep their places in it.
template <int D>
runtime::TaskDeclaration move_particles(const Method<D>& method, int material)
{
  const std::string& name = method.materials[static_cast<std::size_t>(material)].name;
  return runtime::task("move rigid particles: " + name)
      .over_patches_and_groups({material})
      .reads(rigid_states.previous(), rigid_states, particle::id.previous(), particle::reference_position<D>.previous(),
             particle::mass.previous(), particle::volume.previous())
      .computes(particle::position<D>, particle::velocity<D>, particle::deformation_gradient<D>, particle::volume,
                particle::stress<D>, particle::viscous_pressure)
      .reduces(step_totals, grid_totals)
      .body([&method](const TaskContext& at, auto data) {
        const auto id = data[particle::id.previous()];
        const auto mass = data[particle::mass.previous()];
        const auto reference = data[particle::reference_position<D>.previous()];
        const auto old_volume = data[particle::volume.previous()];
        const auto position = data[particle::position<D>];
        const auto velocity = data[particle::velocity<D>];
        const auto deformation = data[particle::deformation_gradient<D>];
        const auto volume = data[particle::volume];
        const auto stress = data[particle::stress<D>];
        const auto viscous_pressure = data[particle::viscous_pressure];
        StepTotals& totals = data[step_totals];
        GridTotals of_gravity;
        const RigidBody& body = *method.rigid_body(at.group);
        const components::RigidState& state = data[rigid_states].of(body);
        add_totals(at, body, data[rigid_states.previous()], data[rigid_states], data[grid_totals], totals);
        const components::RigidMotion motion = components::motion_of(body.properties, state);
        const Placement<D> before(body, data[rigid_states.previous()].of(body)), after(body, state);
        const SceneBody& of_scene = method.scene.bodies[static_cast<std::size_t>(body.body)];
        const bool in_sectors = of_scene.functions.layout.has_value(), weighs = !method.is_weightless();
        for (std::size_t p = 0; p < id.size(); ++p) {
          position[p] = after(reference[p]);
          velocity[p] = motion.at(in_space<D>(position[p])).template head<D>();
          deformation[p] =
              in_sectors ? after.turn * particle_axes<D>(method.scene, of_scene, reference[p]) : after.turn;
          volume[p] = old_volume[p];
          stress[p].setZero();
          viscous_pressure[p] = 0;
          if (weighs) {
            add_gravity_work<D>(method, at.step.size, mass[p], before(reference[p]), position[p], velocity[p],
                                of_gravity);
          }
          if (!is_clear_of_edges<D>(at.layout.grid(), method.scene.reach_of(at.group), body.touchable, position[p])) {
            throw SimulationError("a rigid body reaches the edge of the domain, where nothing is known to hold it",
                                  method.materials[static_cast<std::size_t>(at.group)].name, id[p],
                                  {position[p].begin(), position[p].end()});
          }
          totals.stable_step =
              std::min(totals.stable_step, components::published_time_step<D>(method.cell_size, 0, velocity[p]));
        }
        runtime::combine(data[grid_totals], of_gravity);
      });
}

template <int D>
runtime::TaskList move_rigid_particles(const Method<D>& method)
{
  runtime::TaskList tasks;
  for (const RigidBody& body : method.rigid_bodies) tasks.push_back(move_particles(method, body.material));
  return tasks;
}

template runtime::TaskList accelerate_rigid_bodies(const Method<2>&);
template runtime::TaskList accelerate_rigid_bodies(const Method<3>&);
template runtime::TaskList move_rigid_bodies(const Method<2>&);
template runtime::TaskList move_rigid_bodies(const Method<3>&);
template runtime::TaskList move_rigid_particles(const Method<2>&);
template runtime::TaskList move_rigid_particles(const Method<3>&);

}  // namespace tamp::tasks
