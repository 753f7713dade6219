#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_driven_body
{

/// Rigid bodies whose motion is given: where they are, what they feel, and what driving them costs.
using namespace tamp;
using namespace tamp::test;
using components::PrescribedMotion;

namespace
{

constexpr double cell = 0.1;

/// A rigid box of a material of its own that goes as said.
SceneBody& add_driven_box(Scene& scene, const Triple& lower, const Triple& upper, const PrescribedMotion& motion,
                          bool turns = false)
{
  SceneBody& body = add_box(scene, add_elastic(scene, 2000, 1e9, 0.3), lower, upper);
  body.rigid = true;
  body.drive = {motion, turns};
  const Vector<3> velocity = motion.velocity(0);
  std::copy(velocity.begin(), velocity.end(), body.velocity.begin());
  return body;
}

/// Down by `depth` within `duration`, gently at first and at the end.
PrescribedMotion push(double depth, double duration = 1)
{
  std::vector<PrescribedMotion::Point> velocities;
  constexpr int n = 40;
  for (int i = 0; i <= n; ++i) {
    const double s = std::sin(std::numbers::pi * i / n);
    velocities.push_back({duration * i / n, {0, -2 * depth / duration * s * s, 0}});
  }
  return PrescribedMotion::of_velocities(velocities);
}

/// An elastic column of 0.4 m by 1 m between smooth walls, and a driven plate on it as wide as they are apart.
Scene pressed_column(double depth)
{
  Scene scene = empty_scene(2, {4, 14, 1}, cell);
  add_walls(scene, 0);
  add_walls(scene, 1);
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.25), {0, 0, 0}, {0.4, 1, 0});
  add_driven_box(scene, {0, 1, 0}, {0.4, 1.2, 0}, push(depth, 4));
  return scene;
}

/// Half or all of a stamp that is pushed into an elastic block, the half with a mirror at x = 0.
Scene stamp(bool half)
{
  const double left = half ? 0 : 1;
  Scene scene = empty_scene(2, {half ? 10 : 20, 12, 1}, cell);
  scene.n_patches = {half ? 2 : 4, 2, 1};
  add_walls(scene, 1);
  if (half) scene.faces[0][0] = components::SymmetryFace();
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.25), {left - (half ? 0 : 0.7), 0, 0}, {left + 0.7, 0.7, 0});
  add_driven_box(scene, {left - (half ? 0 : 0.2), 0.7, 0}, {left + 0.2, 1, 0}, push(0.1));
  scene.time.maximum_step = 5e-4;
  return scene;
}

/// A driven bar whose right end alone meets a block.
Scene bar_on_a_corner(bool turns)
{
  Scene scene = empty_scene(2, {16, 12, 1}, cell);
  scene.n_patches = {4, 3, 1};
  add_walls(scene, 1);
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.25), {0.9, 0, 0}, {1.3, 0.5, 0});
  add_driven_box(scene, {0.3, 0.5, 0}, {1.1, 0.7, 0}, push(0.2), turns);
  return scene;
}

/// Mean over the particles whose y is within these bounds.
double mean_stress_yy(const std::vector<Particle>& particles, double lower, double upper)
{
  double sum = 0, n = 0;
  for (const Particle& p : particles) {
    if (p.position.y() < lower || p.position.y() > upper) continue;
    sum += p.stress[1];
    ++n;
  }
  return sum / n;
}

Eigen::Vector3d way_of(const BodySums& body)
{
  return (body.position - body.reference_position) / body.mass;
}

}  // namespace

TEST_CASE("a driven body is where its motion takes it, and feels what the column bears")
{
  const auto simulation = Simulation::make(pressed_column(0.05), 1);

  advance_to(*simulation, 4);
  simulation->take_mean_forces();
  advance_to(*simulation, 4.1);

  const ParticleReport report = simulation->report();
  CHECK(way_of(report.bodies[1]).y() == Approx(-0.05).epsilon(1e-10));
  const std::vector<Particle> column = particles_of_material(particles_of(*simulation), 0);
  const double strain = std::log(1 - 0.05);
  CHECK(mean_stress_yy(column, 0, 1) == Approx(uniaxial_modulus(1e6, 0.25) * strain).epsilon(0.01));
  const std::vector<ContactForce> forces = simulation->take_mean_forces().contact;
  // The particles at the plate share its nodes, and are strained less than the others.
  CHECK(forces[1].force.y() == Approx(-0.4 * mean_stress_yy(column, 0.1, 0.6)).epsilon(0.005));
  CHECK(forces[0].force.y() == Approx(-forces[1].force.y()).epsilon(1e-10));
}

TEST_CASE("local damping leaves the force of a plate that presses gently, and its work is accounted for")
{
  Scene scene = pressed_column(0.05);
  scene.local_damping = 0.3;
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, 4);
  const EnergyLedger energies = simulation->energies();
  CHECK(worked(energies) + simulation->report().kinetic == Approx(energies.driving).epsilon(2e-3));
  CHECK(energies.viscous < 0.01 * energies.driving);
  simulation->take_mean_forces();
  advance_to(*simulation, 4.1);

  const std::vector<Particle> column = particles_of_material(particles_of(*simulation), 0);
  CHECK(mean_stress_yy(column, 0, 1) == Approx(uniaxial_modulus(1e6, 0.25) * std::log(1 - 0.05)).epsilon(0.01));
  CHECK(simulation->take_mean_forces().contact[1].force.y() ==
        Approx(-0.4 * mean_stress_yy(column, 0.1, 0.6)).epsilon(0.01));
}

TEST_CASE("the mean force of a body that is held is the same over many steps and over three with a last one cut short")
{
  Scene scene = pressed_column(0.05);
  scene.local_damping = 0.3;
  const auto simulation = Simulation::make(scene, 1);
  advance_to(*simulation, 4.1);
  simulation->take_mean_forces();
  advance_to(*simulation, 4.2);
  const double over_many = simulation->take_mean_forces().contact[1].force.y();

  advance_to(*simulation, simulation->time() + 2.25 * simulation->last_step_size());

  CHECK(simulation->take_mean_forces().contact[1].force.y() == Approx(over_many).epsilon(0.002));
}

TEST_CASE("the work of driving a body goes into what it presses")
{
  const auto simulation = Simulation::make(pressed_column(0.05), 1);

  advance_to(*simulation, 4);

  const EnergyLedger& energies = simulation->energies();
  const double kinetic = simulation->report().kinetic;
  CHECK(energies.driving > 100);
  CHECK(worked(energies) + kinetic == Approx(energies.driving).epsilon(1e-3));
}

TEST_CASE("half a driven body on a mirror feels half the force of the whole")
{
  const auto whole = Simulation::make(stamp(false), 1), half = Simulation::make(stamp(true), 1);

  advance_to(*whole, 0.7);
  advance_to(*half, 0.7);

  const Eigen::Vector3d of_whole = whole->take_mean_forces().contact[1].force;
  const Eigen::Vector3d of_half = half->take_mean_forces().contact[1].force;
  REQUIRE(of_whole.y() > 1000);
  CHECK(of_half.y() == Approx(of_whole.y() / 2).epsilon(1e-9));
  CHECK(std::abs(of_whole.x()) < 1e-9 * of_whole.y());
}

TEST_CASE("a driven body is turned by what it meets only where its rotation is free")
{
  const auto held = Simulation::make(bar_on_a_corner(false), 1), turning = Simulation::make(bar_on_a_corner(true), 1);

  advance_to(*held, 0.6);
  advance_to(*turning, 0.6);

  const BodySums of_held = held->report().bodies[1], of_turning = turning->report().bodies[1];
  CHECK(std::abs(of_held.tilt(2)) < 1e-12);
  CHECK(of_turning.tilt(2) > 0.05);
  const double way = push(0.2).way(0, 0.6).y();
  CHECK(way_of(of_held).y() == Approx(way).epsilon(1e-10));
  CHECK(way_of(of_turning).y() == Approx(way).epsilon(1e-10));
  const std::vector<ContactForce> forces = held->take_mean_forces().contact;
  const double arm = forces[1].torque.z() / forces[1].force.y();
  CHECK(arm > 0.2);
  CHECK(arm < 0.4);
}

TEST_CASE("a driven body ends with the same bits on any ranks and threads", "[ranks]")
{
  const bool turns = GENERATE(false, true);
  const Scene scene = bar_on_a_corner(turns);
  const auto alone = Simulation::make(scene, 1);
  advance_to(*alone, 0.6);

  for (const int n_threads : {1, 2}) {
    const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()),
                                             runtime::Communicator::world());
    advance_to(*simulation, 0.6);
    CHECK(simulation->digest() == alone->digest());
    CHECK(simulation->energies().driving == alone->energies().driving);
    CHECK(simulation->take_mean_forces().contact[1].torque.z() != 0);
  }
}

}  // namespace test_driven_body
