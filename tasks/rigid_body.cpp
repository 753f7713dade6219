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

components::RigidState moved(const components::MassProperties& body, const components::RigidState& free,
                             const ContactImpulses::Impulse& impulse, double dt)
{
  components::RigidState state = free;
  state.momentum += impulse.linear;
  state.angular_momentum += impulse.angular;
  try {
    return components::drift(body, state, dt);
  } catch (const components::BadValue& bad) {
    throw SimulationError(std::string("a rigid body cannot be followed: ") + bad.what(), "", -1, {});
  }
}

}  // namespace tamp::tasks
