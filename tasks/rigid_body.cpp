#include "tasks/rigid_body.hpp"

#include <string>

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

std::array<std::array<bool, 2>, 3> touchable_faces(const Scene& scene, const SceneBody& body)
{
  std::array<std::array<bool, 2>, 3> touchable{};
  if (!body.drive || body.drive->turns) return touchable;
  for (int axis = 0; axis < scene.grid.dimension; ++axis) {
    if (body.drive->motion.has_part_along(axis)) continue;
    const auto k = static_cast<std::size_t>(axis);
    for (std::size_t side = 0; side < 2; ++side) touchable[k][side] = scene.faces[k][side] == Face::symmetry;
  }
  return touchable;
}

components::RigidState moved(const components::MassProperties& body, const components::RigidState& free,
                             const ContactImpulses::Impulse& impulse, components::Held held, double dt)
{
  components::RigidState state = free;
  if (held == components::Held::nothing) state.momentum += impulse.linear;
  if (held != components::Held::all) state.angular_momentum += impulse.angular;
  try {
    return components::drift(body, state, dt);
  } catch (const components::BadValue& bad) {
    throw SimulationError(std::string("a rigid body cannot be followed: ") + bad.what(), "", -1, {});
  }
}

}  // namespace tamp::tasks
