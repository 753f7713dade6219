#include "components/rigid/rigid_body.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

MassProperties mass_properties(std::span<const double> mass, std::span<const Vector3> position, double particle_size,
                               bool plane)
{
  if (mass.size() < 2) throw BadValue(std::to_string(mass.size()) + " particles in a rigid body", "2 or more");
  MassProperties body;
  Vector3 moment = Vector3::Zero();
  for (std::size_t p = 0; p < mass.size(); ++p) {
    body.mass += mass[p];
    moment += mass[p] * position[p];
  }
  body.centre = moment / body.mass;
  Matrix3 second = body.mass * particle_size * particle_size / 12 * Matrix3::Identity();
  for (std::size_t p = 0; p < mass.size(); ++p) {
    const Vector3 r = position[p] - body.centre;
    second += mass[p] * r * r.transpose();
  }
  body.inertia = second.trace() * Matrix3::Identity() - second;
  // In the plane the other two axes never turn; any inertia will do for them.
  if (plane) body.inertia = body.inertia(2, 2) * Matrix3::Identity();
  body.inverse_inertia = body.inertia.inverse();
  return body;
}

Matrix3 inertia_now(const MassProperties& body, const RigidState& state)
{
  const Matrix3 turn = state.orientation.toRotationMatrix();
  return turn * body.inertia * turn.transpose();
}

Matrix3 inverse_inertia_now(const MassProperties& body, const RigidState& state)
{
  const Matrix3 turn = state.orientation.toRotationMatrix();
  return turn * body.inverse_inertia * turn.transpose();
}

Vector3 angular_velocity(const MassProperties& body, const RigidState& state)
{
  return inverse_inertia_now(body, state) * state.angular_momentum;
}

double kinetic_energy(const MassProperties& body, const RigidState& state)
{
  return 0.5 * state.momentum.squaredNorm() / body.mass +
         0.5 * state.angular_momentum.dot(angular_velocity(body, state));
}

RigidMotion motion_of(const MassProperties& body, const RigidState& state)
{
  return {state.centre, state.momentum / body.mass, angular_velocity(body, state)};
}

namespace
{

/// The rotation by the Cayley map of w dt: as a quaternion, (1, w dt / 2) of unit length.
Eigen::Quaterniond cayley(const Vector3& w, double dt)
{
  Eigen::Quaterniond turn;
  turn.w() = 1;
  turn.vec() = 0.5 * dt * w;
  return turn.normalized();
}

}  // namespace

RigidState drift(const MassProperties& body, const RigidState& state, double dt)
{
  const Vector3 old_momentum = state.orientation.conjugate() * state.angular_momentum;
  const Vector3 old_spin = body.inverse_inertia * old_momentum;
  Vector3 spin = old_spin;
  Eigen::Quaterniond turn = cayley(spin, dt);
  // Contracts as |w| dt < 1 in every step that moves the surface by less than its radius; then this is far more than
  // enough, and the loop ends when round-off is reached.
  constexpr int most_iterations = 200;
  double change = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_iterations; ++i) {
    const Vector3 new_momentum = turn.conjugate() * old_momentum;
    const Vector3 midpoint = 0.5 * (old_spin + body.inverse_inertia * new_momentum);
    const double new_change = (midpoint - spin).norm();
    spin = midpoint;
    turn = cayley(spin, dt);
    if (new_change == 0 || (new_change >= change && new_change < 1e-12 * spin.norm())) break;
    change = new_change;
  }
  RigidState moved = state;
  moved.centre += dt / body.mass * state.momentum;
  moved.orientation = (state.orientation * turn).normalized();
  return moved;
}

}  // namespace tamp::components
