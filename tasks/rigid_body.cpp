#include "tasks/rigid_body.hpp"

namespace tamp::tasks
{

components::RigidState moved(const RigidBody& body, const ContactImpulses::Impulse& impulse, double dt)
{
  components::RigidState state = body.free;
  state.momentum += impulse.linear;
  state.angular_momentum += impulse.angular;
  return components::drift(body.properties, state, dt);
}

}  // namespace tamp::tasks
