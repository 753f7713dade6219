#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "tests/tasks/scenes.hpp"

namespace test_rotating_frame
{

using namespace tamp;
using namespace tamp::test;

namespace
{

const Eigen::Vector3d axis(1, -2, 2), centre(0.9, -0.4, 1.3);

/// One particle, which nothing but its frame acts on, with a velocity of that frame.
Scene lone_particle(double angular_speed, double angular_acceleration)
{
  Scene scene = empty_scene(3, {12, 12, 12}, 0.05);
  scene.n_patches = {2, 1, 3};
  scene.particles_per_axis = 1;
  scene.centrifuge.emplace(angular_speed, axis, centre, angular_acceleration);
  add_box(scene, add_elastic(scene, 1000, 1e3, 0.3), {0.25, 0.25, 0.25}, {0.3, 0.3, 0.3}, {-0.4, 1.1, -0.3});
  return scene;
}

/// Distance of the particle from where it would be if it had gone straight on in space.
double error_of_flight(const Scene& given, double angular_speed, double angular_acceleration, int n_steps)
{
  constexpr double end = 0.1;
  Scene scene = given;
  scene.time.maximum_step = end / n_steps;
  const auto simulation = Simulation::make(scene, 1);
  const Particle start = particles_of(*simulation)[0];

  advance_to(*simulation, end);

  REQUIRE(simulation->n_steps() <= n_steps + 1);
  const Eigen::Vector3d w = angular_speed * axis.normalized();
  const Eigen::Vector3d in_space = start.position + end * (start.velocity + w.cross(start.position - centre)) - centre;
  const double angle = angular_speed * end + 0.5 * angular_acceleration * end * end;
  const Eigen::Vector3d expected = centre + Eigen::AngleAxisd(-angle, axis.normalized()) * in_space;
  return (particles_of(*simulation)[0].position - expected).norm();
}

}  // namespace

TEST_CASE("a free particle in a rotating frame goes straight on in space, to second order in the step")
{
  const double speed = 3, acceleration = GENERATE(0.0, 20.0);
  const Scene scene = lone_particle(speed, acceleration);

  const double coarse = error_of_flight(scene, speed, acceleration, 40);
  const double middle = error_of_flight(scene, speed, acceleration, 80);
  const double fine = error_of_flight(scene, speed, acceleration, 160);

  CHECK(coarse < 1e-4);
  CHECK(std::log2(coarse / middle) == Approx(2).margin(0.1));
  CHECK(std::log2(middle / fine) == Approx(2).margin(0.1));
}

TEST_CASE("what a free particle gains in energy is the work of a steady centrifuge")
{
  Scene scene = lone_particle(3, 0);
  scene.time.maximum_step = 1e-4;
  const auto simulation = Simulation::make(scene, 1);
  const ParticleReport start = simulation->report();

  advance_to(*simulation, 0.1);

  const ParticleReport end = simulation->report();
  const double gain = end.kinetic - start.kinetic;
  CHECK(std::abs(gain) > 0.01 * start.kinetic);
  // Velocities are those of the middle of the step.
  CHECK(end.gravity_work - start.gravity_work == Approx(gain).epsilon(2e-3));
}

}  // namespace test_rotating_frame
