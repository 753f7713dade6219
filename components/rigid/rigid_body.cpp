#include "components/rigid/rigid_body.hpp"

#include <Eigen/LU>
#include <algorithm>
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

MassProperties half_of_whole(const MassProperties& half, int axis, double place)
{
  MassProperties body = half;
  Matrix3 second = half.second_moment();
  const double arm = half.centre[axis] - place, across = second(axis, axis) + half.mass * arm * arm;
  second.row(axis).setZero();
  second.col(axis).setZero();
  second(axis, axis) = across;
  body.centre[axis] = place;
  body.inertia = second.trace() * Matrix3::Identity() - second;
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

/// The turn of one step, as seen in the body, from the angular momentum there. Where |I^-1| |momentum| dt is below 1/2
/// each pass brings the midpoint four times nearer, until round-off stops it.
Eigen::Quaterniond midpoint_turn(const MassProperties& body, const Vector3& momentum, double dt)
{
  const Vector3 old_spin = body.inverse_inertia * momentum;
  Vector3 spin = old_spin;
  double change = std::numeric_limits<double>::infinity();
  while (true) {
    const Vector3 new_momentum = cayley(spin, dt).conjugate() * momentum;
    const Vector3 midpoint = 0.5 * (old_spin + body.inverse_inertia * new_momentum);
    const double new_change = (midpoint - spin).norm();
    spin = midpoint;
    if (!(new_change < change)) return cayley(spin, dt);
    change = new_change;
  }
}

/// Into how many parts a step is cut for the midpoint to be found.
int parts_of_turn(const MassProperties& body, const RigidState& state, double dt)
{
  constexpr double most = 1000;
  const double parts = std::ceil(2 * body.inverse_inertia.norm() * state.angular_momentum.norm() * dt);
  if (!(parts <= most)) {
    throw BadValue("an angular velocity of " + std::to_string(angular_velocity(body, state).norm()) + " rad/s",
                   "one that turns the body by less in a step of " + std::to_string(dt) + " s");
  }
  return std::max(1, static_cast<int>(parts));
}

}  // namespace

RigidState drift(const MassProperties& body, const RigidState& state, double dt)
{
  RigidState moved = state;
  moved.centre += dt / body.mass * state.momentum;
  const int parts = parts_of_turn(body, state, dt);
  for (int i = 0; i < parts; ++i) {
    const Vector3 momentum = moved.orientation.conjugate() * state.angular_momentum;
    moved.orientation = (moved.orientation * midpoint_turn(body, momentum, dt / parts)).normalized();
  }
  return moved;
}

}  // namespace tamp::components
