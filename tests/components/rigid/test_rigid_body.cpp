#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "components/errors.hpp"
#include "components/rigid/rigid_body.hpp"

namespace test_rigid_body
{

using namespace tamp::components;

namespace
{

/// A body with three different moments of inertia that spins about an axis near the middle one: it tumbles.
MassProperties asymmetric_top()
{
  MassProperties body;
  body.mass = 2;
  body.centre = {0.1, -0.2, 0.3};
  const Matrix3 turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  body.inertia = turn * Vector3(1, 2, 3).asDiagonal() * turn.transpose();
  body.inverse_inertia = body.inertia.inverse();
  return body;
}

RigidState tumbling(const MassProperties& body, const Vector3& spin)
{
  RigidState state;
  state.centre = body.centre;
  state.momentum = body.mass * Vector3(3, -1, 2);
  state.angular_momentum = body.inertia * spin;
  return state;
}

/// The angular momentum that the body's spin and inertia make, not the one that is stored.
Vector3 momentum_of_spin(const MassProperties& body, const RigidState& state)
{
  return inertia_now(body, state) * angular_velocity(body, state);
}

/// Where the orientation is after `time`, in steps.
Eigen::Quaterniond turned(const MassProperties& body, RigidState state, double time, int n_steps)
{
  for (int i = 0; i < n_steps; ++i) state = drift(body, state, time / n_steps);
  return state.orientation;
}

}  // namespace

TEST_CASE("torque-free tumbling keeps energy and angular momentum over 1000 turns")
{
  const MassProperties body = asymmetric_top();
  const Vector3 spin = Vector3(0.02, 1, 0.01) * 2 * std::numbers::pi;
  RigidState state = tumbling(body, spin);
  const double energy = kinetic_energy(body, state);
  const Vector3 momentum = state.angular_momentum;
  const int n_steps = 1000 * 50;
  double energy_error = 0, momentum_error = 0, tumble = 1;
  for (int i = 0; i < n_steps; ++i) {
    state = drift(body, state, 0.02);
    energy_error = std::max(energy_error, std::abs(kinetic_energy(body, state) / energy - 1));
    momentum_error = std::max(momentum_error, (momentum_of_spin(body, state) - momentum).norm() / momentum.norm());
    const Vector3 axis_in_body = state.orientation.conjugate() * angular_velocity(body, state).normalized();
    tumble = std::min(tumble, axis_in_body.dot(spin.normalized()));
  }
  CAPTURE(energy_error, momentum_error, tumble);
  CHECK(energy_error < 1e-10);
  CHECK(momentum_error < 1e-10);
  // The axis of the middle moment is unstable: the body turns over.
  CHECK(tumble < -0.5);
  CHECK((state.centre - body.centre - Vector3(3, -1, 2) * 0.02 * n_steps).norm() < 1e-9 * 0.02 * n_steps);
}

TEST_CASE("steps that turn a body by two radians keep energy and angular momentum, of a thin rod too")
{
  MassProperties body = asymmetric_top();
  if (GENERATE(false, true)) {
    body.inertia = Vector3(1, 50, 50).asDiagonal();
    body.inverse_inertia = body.inertia.inverse();
  }
  RigidState state = tumbling(body, {0.3, 1.9, 0.5});
  const double energy = kinetic_energy(body, state);
  const Vector3 momentum = state.angular_momentum;

  for (int i = 0; i < 1000; ++i) {
    state = drift(body, state, 1.0);

    REQUIRE(kinetic_energy(body, state) == Approx(energy).epsilon(1e-11));
    REQUIRE((momentum_of_spin(body, state) - momentum).norm() < 1e-11 * momentum.norm());
  }
}

TEST_CASE("a body that spins beyond all measure is refused, not turned anyhow")
{
  const MassProperties body = asymmetric_top();
  const double spin = GENERATE(1e6, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN());

  CHECK_THROWS_AS(drift(body, tumbling(body, {spin, 0, 0}), 0.01), BadValue);
}

TEST_CASE("a symmetric top precesses as Euler has it, second order in the step")
{
  MassProperties body;
  body.mass = 1;
  body.inertia = Vector3(2, 2, 1).asDiagonal();
  body.inverse_inertia = body.inertia.inverse();
  const RigidState state = tumbling(body, {0.8, 0, 3});
  // In space: a turn about L by |L| / I_1, after one about the body's axis by w_3 (I_1 - I_3) / I_1.
  const double time = 2.0;
  const Vector3 along = state.angular_momentum.normalized();
  const Eigen::Quaterniond exact(Eigen::AngleAxisd(state.angular_momentum.norm() / 2 * time, along) *
                                 Eigen::AngleAxisd(3 * (2.0 - 1.0) / 2 * time, Vector3::UnitZ()));
  const double coarse = turned(body, state, time, 100).angularDistance(exact);
  const double fine = turned(body, state, time, 200).angularDistance(exact);
  CAPTURE(coarse, fine);
  CHECK(fine < 1e-3);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.05));
}

TEST_CASE("mass properties of particles are those of the box that they fill")
{
  const Vector3 sides(0.4, 0.2, 0.6);
  const double size = 0.1, density = 7;
  std::vector<Vector3> places;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 6; ++k) places.emplace_back(1 + size * (i + 0.5), 2 + size * (j + 0.5), size * (k + 0.5));
    }
  }
  const std::vector<double> mass(places.size(), density * size * size * size);
  const MassProperties body = mass_properties(mass, places, size, false);
  const double m = density * sides.prod();
  CHECK(body.mass == Approx(m).epsilon(1e-14));
  CHECK((body.centre - Vector3(1.2, 2.1, 0.3)).norm() < 1e-14);
  const Vector3 squares = sides.cwiseAbs2();
  const Vector3 moments = m / 12 * (Vector3::Constant(squares.sum()) - squares);
  CHECK((body.inertia - Matrix3(moments.asDiagonal())).norm() < 1e-14 * m);
  CHECK((body.second_moment() - Matrix3((m / 12 * squares).asDiagonal())).norm() < 1e-14 * m);

  const MassProperties slab = mass_properties(mass, places, size, true);
  CHECK((slab.inertia - moments[2] * Matrix3::Identity()).norm() < 1e-14 * m);
}

TEST_CASE("one particle is no rigid body")
{
  const std::vector<double> mass{1};
  const std::vector<Vector3> place{Vector3::Zero()};
  CHECK_THROWS_AS(mass_properties(mass, place, 0.1, false), BadValue);
}

}  // namespace test_rigid_body
