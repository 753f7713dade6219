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

components::RigidState accelerated(const RigidBody& body, const Eigen::Vector3d& gravity,
                                   const std::optional<components::RotatingFrame>& frame, double time, double kick)
{
  const components::MassProperties& properties = body.properties;
  components::RigidState state = body.state;
  if (!frame) {
    state.momentum += kick * properties.mass * gravity;
    return state;
  }
  const Eigen::Vector3d velocity = state.momentum / properties.mass;
  state.momentum += properties.mass * frame->velocity_change(state.centre, velocity, gravity, time, kick);

  // The Coriolis torque takes the mean of the spins before and after, found by iteration: it is small, as the frame
  // turns little in a step.
  const Eigen::Matrix3d turn = state.orientation.toRotationMatrix();
  const Eigen::Matrix3d second_moment = turn * properties.second_moment() * turn.transpose();
  const Eigen::Vector3d old_spin = components::angular_velocity(properties, state);
  constexpr int n_iterations = 4;
  for (int i = 0; i < n_iterations; ++i) {
    const Eigen::Vector3d spin = 0.5 * (old_spin + components::angular_velocity(properties, state));
    state.angular_momentum = body.state.angular_momentum + kick * torque(*frame, time, second_moment, spin);
  }
  return state;
}

components::RigidState moved(const RigidBody& body, const ContactImpulses::Impulse& impulse, double dt)
{
  components::RigidState state = body.free;
  state.momentum += impulse.linear;
  state.angular_momentum += impulse.angular;
  try {
    return components::drift(body.properties, state, dt);
  } catch (const components::BadValue& bad) {
    throw SimulationError(std::string("a rigid body cannot be followed: ") + bad.what(), "", -1, {});
  }
}

}  // namespace tamp::tasks
