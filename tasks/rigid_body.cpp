#include "tasks/rigid_body.hpp"

#include <string>
#include <variant>

#include "components/errors.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

namespace
{

/// Torque about the centre of mass of a body that spins by `spin` [N m]: sum m r x (A r + B (spin x r)), A and B being
/// the gradients of the frame's acceleration.
Eigen::Vector3d torque(const components::RotatingFrame& frame, double time, const Eigen::Matrix3d& second_moment,
                       const Eigen::Vector3d& spin)
{
  const Eigen::Matrix3d gradient =
      frame.gradient_by_position(time) + frame.gradient_by_velocity(time) * cross_matrix(spin);
  const Eigen::Matrix3d moment = second_moment * gradient.transpose();
  return {moment(1, 2) - moment(2, 1), moment(2, 0) - moment(0, 2), moment(0, 1) - moment(1, 0)};
}

}  // namespace

components::RigidState initial_state(const components::MassProperties& body, const Eigen::Vector3d& velocity,
                                     const Eigen::Vector3d& angular_velocity)
{
  return {.centre = body.centre, .momentum = body.mass * velocity, .angular_momentum = body.inertia * angular_velocity};
}

components::RigidState accelerated(const components::MassProperties& body, const components::RigidState& before,
                                   const Eigen::Vector3d& gravity,
                                   const std::optional<components::RotatingFrame>& frame, double time, double kick)
{
  components::RigidState state = before;
  if (!frame) {
    state.momentum += kick * body.mass * gravity;
    return state;
  }
  const Eigen::Vector3d velocity = state.momentum / body.mass;
  state.momentum += body.mass * frame->velocity_change(state.centre, velocity, gravity, time, kick);

  // The Coriolis torque takes the mean of the spins before and after, found by iteration: it is small, as the frame
  // turns little in a step.
  const Eigen::Matrix3d turn = state.orientation.toRotationMatrix();
  const Eigen::Matrix3d second_moment = turn * body.second_moment() * turn.transpose();
  const Eigen::Vector3d old_spin = components::angular_velocity(body, state);
  constexpr int n_iterations = 4;
  for (int i = 0; i < n_iterations; ++i) {
    const Eigen::Vector3d spin = 0.5 * (old_spin + components::angular_velocity(body, state));
    state.angular_momentum = before.angular_momentum + kick * torque(*frame, time, second_moment, spin);
  }
  return state;
}

components::RigidState driven(const components::MassProperties& body, const BodyDrive& drive,
                              const components::RigidState& free, double time, double dt)
{
  components::RigidState state = free;
  state.momentum = body.mass / dt * drive.motion.way(time, time + dt);
  if (!drive.turns) state.angular_momentum.setZero();
  return state;
}

components::Held RigidBody::held() const
{
  components::Held held = still;
  if (drive == nullptr) return held;
  const components::Held& driven = drive->turns ? components::translation_held : components::all_held;
  for (std::size_t i = 0; i < held.size(); ++i) held[i] |= driven[i];
  return held;
}

namespace
{

template <int D>
Sides mirrors_beneath(const Scene& scene, const SceneBody& body)
{
  const components::Box<D> box = std::get<components::Solid<D>>(body.solid).bounding_box();
  const runtime::Grid& grid = scene.grid;
  const double near = 0.5 * grid.cell_size / scene.particles_per_axis_of(body.material);
  Sides beneath{};
  for (int axis = 0; axis < D; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const auto& faces = scene.faces[k];
    beneath[k] = {
        components::traits_of(faces[0]).is_mirror && box.lower[axis] < grid.coordinate(axis, 0) + near,
        components::traits_of(faces[1]).is_mirror && box.upper[axis] > grid.coordinate(axis, grid.n_cells[k]) - near};
  }
  return beneath;
}

}  // namespace

Sides mirrors_beneath(const Scene& scene, const SceneBody& body)
{
  return scene.grid.dimension == 2 ? mirrors_beneath<2>(scene, body) : mirrors_beneath<3>(scene, body);
}

Sides touchable_mirrors(const Scene& scene, const SceneBody& body)
{
  if (!body.drive || body.drive->turns) return mirrors_beneath(scene, body);
  Sides touchable{};
  for (int axis = 0; axis < scene.grid.dimension; ++axis) {
    if (body.drive->motion.has_part_along(axis)) continue;
    const auto k = static_cast<std::size_t>(axis);
    for (std::size_t side = 0; side < 2; ++side)
      touchable[k][side] = components::traits_of(scene.faces[k][side]).is_mirror;
  }
  return touchable;
}

components::Held still_on_planes(const std::array<bool, 3>& normal_to)
{
  components::Held still{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!normal_to[axis]) continue;
    still[axis] = true;
    still[3 + (axis + 1) % 3] = still[3 + (axis + 2) % 3] = true;
  }
  return still;
}

RigidBody make_rigid_body(const Scene& scene, int body)
{
  const SceneBody& given = scene.bodies[static_cast<std::size_t>(body)];
  RigidBody rigid{.body = body,
                  .material = given.material,
                  .drive = given.drive ? &*given.drive : nullptr,
                  .touchable = touchable_mirrors(scene, given)};
  if (given.drive && !given.drive->turns) return rigid;
  const Sides& on = rigid.touchable;
  rigid.still = still_on_planes({on[0][0] || on[0][1], on[1][0] || on[1][1], on[2][0] || on[2][1]});
  if (scene.axisymmetric) {
    for (const std::size_t across : {0U, 2U, 3U, 4U, 5U}) rigid.still[across] = true;
  }
  return rigid;
}

components::MassProperties within_whole(const RigidBody& body, const Scene& scene,
                                        const components::MassProperties& of_particles)
{
  components::MassProperties properties = of_particles;
  // Rings are about the axis already.
  for (int axis = scene.axisymmetric ? 1 : 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    // On both sides it lies between walls.
    if (!body.still[k] || body.touchable[k][0] == body.touchable[k][1]) continue;
    const double plane = scene.grid.coordinate(axis, body.touchable[k][0] ? 0 : scene.grid.n_cells[k]);
    properties = components::half_of_whole(properties, axis, plane);
  }
  return properties;
}

components::RigidState at_rest_across_mirrors(const RigidBody& body, const components::RigidState& state)
{
  components::RigidState still = state;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (body.still[axis]) still.momentum[k] = 0;
    if (body.still[axis + 3]) still.angular_momentum[k] = 0;
  }
  return still;
}

components::RigidState moved(const components::MassProperties& body, const components::RigidState& free,
                             const ContactImpulses::Impulse& impulse, const components::Held& held, double dt)
{
  components::RigidState state = free;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (!held[axis]) state.momentum[k] += impulse.linear[k];
    if (!held[axis + 3]) state.angular_momentum[k] += impulse.angular[k];
  }
  try {
    return components::drift(body, state, dt);
  } catch (const components::BadValue& bad) {
    throw SimulationError(std::string("a rigid body cannot be followed: ") + bad.what(), "", -1, {});
  }
}

}  // namespace tamp::tasks
