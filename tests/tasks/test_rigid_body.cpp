#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tasks/simulation_error.hpp"
#include "tests/components/materials/concrete_sand.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_rigid_body
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double cell = 0.05;

/// A rigid box of a material of its own. What the material is stiff by does not matter.
SceneBody& add_rigid_box(Scene& scene, double density, const Triple& lower, const Triple& upper, const Triple& velocity)
{
  SceneBody& body = add_box(scene, add_elastic(scene, density, 1e9, 0.3), lower, upper, velocity);
  body.rigid = true;
  return body;
}

/// A rigid cube, or a square, of 4 cells with its centre at 0.25 m on every axis, which flies across patches.
Scene spinning_cube(int dimension)
{
  Scene scene = empty_scene(dimension, {16, 12, dimension == 3 ? 12 : 1}, cell);
  scene.n_patches = {4, 2, 1};
  scene.time.maximum_step = 0.01;
  add_rigid_box(scene, 3000, {0.15, 0.15, 0.15}, {0.35, 0.35, 0.35}, {1, 0.2, dimension == 3 ? 0.1 : 0.0})
      .angular_velocity = dimension == 3 ? Triple{4, -10, 16} : Triple{0, 0, -20};
  return scene;
}

/// The largest change of a distance between two particles [m].
double distortion(const std::vector<Particle>& before, const std::vector<Particle>& after)
{
  double largest = 0;
  for (std::size_t p = 0; p < before.size(); ++p) {
    for (std::size_t q = 0; q < p; ++q) {
      const double was = (before[p].position - before[q].position).norm();
      largest = std::max(largest, std::abs((after[p].position - after[q].position).norm() - was));
    }
  }
  return largest;
}

Eigen::Vector3d centre_of(const BodySums& body)
{
  return body.position / body.mass;
}

/// The centre of particles, all of one mass.
Eigen::Vector3d centre_of(const std::vector<Particle>& particles)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Particle& p : particles) sum += p.position;
  return sum / static_cast<double>(particles.size());
}

/// The largest difference of a particle's velocity from that of the body where it is [m/s].
double straying(const std::vector<Particle>& particles, const BodySums& body)
{
  double largest = 0;
  for (const Particle& p : particles) {
    const Eigen::Vector3d v = body.momentum / body.mass + body.spin().cross(p.position - centre_of(body));
    largest = std::max(largest, (p.velocity - v).norm());
  }
  return largest;
}

}  // namespace

TEST_CASE("a rigid body that spins flies on undeformed through cells and patches")
{
  const int dimension = GENERATE(2, 3);
  const int n_threads = GENERATE(1, 2);
  const auto simulation = Simulation::make(spinning_cube(dimension), n_threads);
  const auto before = particles_of(*simulation);
  const ParticleReport start = simulation->report();
  const Triple velocity = simulation->scene().bodies[0].velocity;

  advance_to(*simulation, 0.25);

  const BodySums body = simulation->report().bodies[0], initial = start.bodies[0];
  CHECK(simulation->n_steps() > 20);
  const auto after = particles_of(*simulation);
  CHECK(distortion(before, after) < 1e-12);
  CHECK((centre_of(after) - centre_of(body)).norm() < 1e-13);
  CHECK(straying(after, body) < 1e-11);
  CHECK((centre_of(body) - centre_of(initial) - 0.25 * Eigen::Vector3d(velocity.data())).norm() < 1e-13);
  CHECK((body.momentum - initial.momentum).norm() < 1e-13 * initial.momentum.norm());
  CHECK((body.angular_momentum - initial.angular_momentum).norm() < 1e-12 * initial.angular_momentum.norm());
  CHECK(simulation->report().kinetic == Approx(start.kinetic).epsilon(1e-12));
  // It has turned by 5 rad.
  CHECK(body.tilt(dimension) > 0.1);
}

TEST_CASE("the particles of a rigid disk on rings stay sectors of it, whatever the interpolator")
{
  Scene scene = empty_scene(2, {12, 12, 1}, 0.1);
  scene.interpolator = GENERATE(Interpolator("cpdi"), Interpolator("gimp"));
  scene.time.maximum_step = 1e-3;
  SceneBody& disk = add_disk(scene, add_elastic(scene, 3000, 1e9, 0.3), 0.6, 0.6, 0.3, {0, 0, 0});
  disk.rigid = true;
  disk.functions.layout = components::PolarLayout{{0.6, 0.6}, 0, 0.3};
  const auto density_of_nodes = [](Simulation& simulation) {
    const runtime::FieldCopy fields = simulation.fields({}, true);
    const runtime::Column& density = fields.nodes->columns.front();
    REQUIRE(density.name == "density");
    const auto values = std::get<std::span<const double>>(density.values);
    return std::vector<double>(values.begin(), values.end());
  };
  const auto simulation = Simulation::make(scene, 1);
  simulation->advance(1);
  const std::vector<double> first = density_of_nodes(*simulation);
  REQUIRE(*std::max_element(first.begin(), first.end()) > 2900);

  simulation->advance(1);

  const std::vector<double> second = density_of_nodes(*simulation);
  for (std::size_t i = 0; i < first.size(); ++i) CHECK(second[i] == Approx(first[i]).epsilon(1e-12).margin(1e-9));
}

TEST_CASE("the energy reported of a rigid body is that of the solid it fills, its particles' own turning counted")
{
  const int dimension = GENERATE(2, 3);
  const auto simulation = Simulation::make(spinning_cube(dimension), 1);
  const SceneBody& cube = simulation->scene().bodies[0];
  const double mass = 3000 * std::pow(0.2, dimension), inertia = mass * 0.2 * 0.2 / 6;
  const double v2 = Eigen::Vector3d(cube.velocity.data()).squaredNorm();
  const double w2 = Eigen::Vector3d(cube.angular_velocity.data()).squaredNorm();

  const ParticleReport report = simulation->report();

  CHECK(report.kinetic == Approx(0.5 * (mass * v2 + inertia * w2)).epsilon(1e-12));
  const Eigen::Vector3d moment = mass * centre_of(report.bodies[0]).cross(Eigen::Vector3d(cube.velocity.data())) +
                                 inertia * Eigen::Vector3d(cube.angular_velocity.data());
  CHECK((report.bodies[0].angular_momentum - moment).norm() < 1e-12 * moment.norm());
}

TEST_CASE("a rigid plate one particle thick is seen to turn and to spin")
{
  Scene scene = empty_scene(3, {12, 12, 12}, cell);
  scene.time.maximum_step = 0.001;
  add_rigid_box(scene, 3000, {0.2, 0.2, 0.3}, {0.4, 0.4, 0.325}, {0, 0, 0}).angular_velocity = {0, 5, 0};
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, 0.02);

  const BodySums plate = simulation->report().bodies[0];
  CHECK(plate.tilt(3) == Approx(0.1).epsilon(1e-4));
  CHECK((plate.spin() - Eigen::Vector3d(0, 5, 0)).norm() < 1e-10);
}

TEST_CASE("a rigid body in free fall follows its parabola exactly, whatever the sizes of its steps")
{
  const int dimension = GENERATE(2, 3);
  Scene scene = spinning_cube(dimension);
  scene.gravity = {1, -2, dimension == 3 ? 3.0 : 0.0};
  const auto simulation = Simulation::make(scene, 1);
  const Eigen::Vector3d start = centre_of(simulation->report().bodies[0]);
  const Eigen::Vector3d velocity(scene.bodies[0].velocity.data()), gravity(scene.gravity.data());

  for (const double end : {0.001, 0.0505, 0.051, 0.09, 0.2}) {
    advance_to(*simulation, end);

    const Eigen::Vector3d way = end * velocity + 0.5 * end * end * gravity;
    REQUIRE((centre_of(simulation->report().bodies[0]) - start - way).norm() < 1e-13);
  }
}

TEST_CASE("a rigid body that tumbles keeps energy and angular momentum over several turns")
{
  Scene scene = empty_scene(3, {16, 16, 16}, cell);
  scene.n_patches = {2, 2, 2};
  scene.time.maximum_step = 0.01;
  // The axis of the middle moment is the y axis, about which no spin lasts.
  add_rigid_box(scene, 3000, {0.25, 0.3, 0.35}, {0.55, 0.5, 0.45}, {0.01, -0.02, 0.03}).angular_velocity = {0.1, 12, 0};
  const auto simulation = Simulation::make(scene, 2);
  const ParticleReport start = simulation->report();
  const Eigen::Vector3d start_momentum = start.bodies[0].angular_momentum;
  double energy_error = 0, momentum_error = 0, least_along_y = 1;

  for (int i = 0; i < 300; ++i) {
    simulation->advance(1e30);

    const ParticleReport report = simulation->report();
    energy_error = std::max(energy_error, std::abs(report.kinetic / start.kinetic - 1));
    momentum_error = std::max(momentum_error, (report.bodies[0].angular_momentum - start_momentum).norm());
    least_along_y = std::min(least_along_y, report.bodies[0].rotation()(1, 1));
  }

  CAPTURE(simulation->time(), energy_error, momentum_error / start_momentum.norm());
  CHECK(12 * simulation->time() > 3 * 2 * std::numbers::pi);
  CHECK(energy_error < 1e-10);
  CHECK(momentum_error < 1e-10 * start_momentum.norm());
  // It has turned over.
  CHECK(least_along_y < -0.5);
}

namespace
{

const Eigen::Vector3d axis(1, -2, 2), centre(0.9, -0.4, 1.3);
constexpr double end_of_flight = 0.1;

/// A rigid block that has a velocity but no spin in space, in a frame that turns.
Scene block_in_centrifuge(double angular_speed)
{
  Scene scene = empty_scene(3, {14, 14, 14}, cell);
  scene.n_patches = {2, 1, 2};
  scene.centrifuge.emplace(angular_speed, axis, centre, 0.0);
  const Eigen::Vector3d w = angular_speed * axis.normalized(), middle(0.35, 0.35, 0.35), in_space(0.3, -0.5, 0.2);
  const Eigen::Vector3d v = in_space - w.cross(middle - centre);
  add_rigid_box(scene, 3000, {0.25, 0.3, 0.325}, {0.45, 0.4, 0.375}, {v[0], v[1], v[2]}).angular_velocity = {
      -w[0], -w[1], -w[2]};
  return scene;
}

/// The largest distance of a particle from where it would be, had the block gone straight on in space.
double error_in_centrifuge(double angular_speed, int n_steps)
{
  Scene scene = block_in_centrifuge(angular_speed);
  scene.time.maximum_step = end_of_flight / n_steps;
  const auto simulation = Simulation::make(scene, 1);
  const auto start = particles_of(*simulation);
  const Eigen::Vector3d way = end_of_flight * Eigen::Vector3d(0.3, -0.5, 0.2);
  const Eigen::AngleAxisd back(-angular_speed * end_of_flight, axis.normalized());

  advance_to(*simulation, end_of_flight);

  REQUIRE(simulation->n_steps() <= n_steps + 1);
  const auto end = particles_of(*simulation);
  double largest = 0;
  for (std::size_t p = 0; p < start.size(); ++p) {
    const Eigen::Vector3d expected = centre + back * (start[p].position + way - centre);
    largest = std::max(largest, (end[p].position - expected).norm());
  }
  return largest;
}

}  // namespace

TEST_CASE("a rigid body in a rotating frame goes straight on and does not turn in space, to second order in the step")
{
  const double coarse = error_in_centrifuge(3, 20), middle = error_in_centrifuge(3, 40);
  const double fine = error_in_centrifuge(3, 80);

  CAPTURE(coarse, middle, fine);
  CHECK(coarse < 1e-4);
  CHECK(std::log2(coarse / middle) == Approx(2).margin(0.1));
  CHECK(std::log2(middle / fine) == Approx(2).margin(0.1));
}

namespace
{

/// A rigid block hits an elastic one off its middle, free of walls.
Scene collision(int dimension, double density_ratio)
{
  Scene scene = empty_scene(dimension, {24, 16, dimension == 3 ? 12 : 1}, cell);
  scene.n_patches = {3, 2, 1};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.time.multiplier = 0.6;
  const int soft = add_elastic(scene, 1000, 1e6, 0.3);
  add_box(scene, soft, {0.5, 0.25, 0.2}, {0.75, 0.5, 0.4}, {0, 0, 0});
  add_rigid_box(scene, 1000 * density_ratio, {0.25, 0.3, 0.2}, {0.45, 0.55, 0.4}, {5, 0.2, 0}).angular_velocity = {0, 0,
                                                                                                                   2};
  scene.contacts.push_back({soft, 1, 0.3});
  return scene;
}

Eigen::Vector3d angular_momentum(const ParticleReport& report)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const BodySums& body : report.bodies) sum += body.angular_momentum;
  return sum;
}

}  // namespace

TEST_CASE("a rigid body that hits a deformable one keeps momentum and gains no energy, however light or heavy it is")
{
  const int dimension = GENERATE(2, 3);
  const double density_ratio = GENERATE(0.01, 1.0, 100.0);
  const auto simulation = Simulation::make(collision(dimension, density_ratio), 2);
  const ParticleReport before = simulation->report();
  double momentum_error = 0, turning_error = 0, largest_energy = 0;

  while (simulation->time() < 0.06) {
    simulation->advance(0.06);

    const ParticleReport now = simulation->report();
    momentum_error = std::max(momentum_error, (now.momentum() - before.momentum()).norm());
    turning_error = std::max(turning_error, (angular_momentum(now) - angular_momentum(before)).norm());
    largest_energy = std::max(largest_energy, now.kinetic + worked(simulation->energies()));
  }

  CAPTURE(dimension, density_ratio, simulation->n_steps());
  CHECK(momentum_error < 1e-13 * before.momentum().norm());
  // Contact keeps angular momentum at every node, but what particles take from the nodes does not quite.
  CHECK(turning_error < 0.02 * angular_momentum(before).norm());
  // Positions and velocities are half a step apart.
  CHECK(largest_energy < 1.01 * before.kinetic);
  // They did meet, and have parted: with a soft blow, a body as heavy as the other comes to less than half its speed.
  const ParticleReport after = simulation->report();
  const double block = after.bodies[0].momentum[0] / after.bodies[0].mass;
  const double rigid = after.bodies[1].momentum[0] / after.bodies[1].mass;
  CHECK(block > rigid);
  CHECK(rigid < (density_ratio > 1 ? 4.95 : 2.5));
  CHECK(simulation->energies().contact > 0);
}

namespace
{

/// A projectile of 4 x 3 cells at 60 m/s meets sand between walls. Deformable, it is a thousand times as stiff.
Scene driven_in(bool rigid)
{
  constexpr double h = 0.02;
  Scene scene = empty_scene(2, {24, 18, 1}, h);
  add_walls(scene, 0);
  scene.faces[1] = {components::SymmetryFace(), components::OpenFace()};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.materials.push_back({"sand", 1624, concrete_sand::sand(components::ElasticUpdate::state)});
  scene.materials.push_back({"projectile", 5000, components::NeoHookean{4e11, 4e11}});
  add_box(scene, 0, {0, 0, 0}, {0.48, 0.16, 0});
  add_box(scene, 1, {0.2, 0.16, 0}, {0.28, 0.22, 0}, {0, -60, 0}).rigid = rigid;
  scene.contacts.push_back({0, 1, 0.1, components::OwnNormal{1}});
  return scene;
}

/// How deep the projectile is after half a millisecond [m], and in how many steps.
struct Depth {
  double depth;
  long n_steps;
};

Depth depth_of(const Scene& scene)
{
  const auto simulation = Simulation::make(scene, 2);
  advance_to(*simulation, 5e-4);
  const BodySums body = simulation->report().bodies[1];
  return {(body.reference_position - body.position)[1] / body.mass, simulation->n_steps()};
}

}  // namespace

TEST_CASE("a rigid projectile goes as deep as a very stiff one, in far fewer steps", "[slow]")
{
  const Depth stiff = depth_of(driven_in(false)), rigid = depth_of(driven_in(true));
  Scene small_steps = driven_in(true);
  small_steps.time.maximum_step = 5e-4 / static_cast<double>(stiff.n_steps);
  const Depth alike = depth_of(small_steps);

  CAPTURE(stiff.depth, stiff.n_steps, alike.depth, alike.n_steps, rigid.depth, rigid.n_steps);
  CHECK(alike.depth == Approx(stiff.depth).epsilon(0.02));
  // The long steps of the impact cost some per cent.
  CHECK(rigid.depth == Approx(stiff.depth).epsilon(0.05));
  CHECK(10 * rigid.n_steps < stiff.n_steps);
}

namespace
{

/// Advances until it cannot, and says why; the state must then be the one before.
std::string failure_of(const Scene& scene)
{
  const auto simulation = Simulation::make(scene, 2);
  while (simulation->n_steps() < 1000) {
    const std::string digest = simulation->digest();
    const long n_steps = simulation->n_steps();
    const Eigen::Vector3d centre_before = centre_of(simulation->report().bodies[0]);
    try {
      simulation->advance(1e30);
    } catch (const SimulationError& error) {
      CHECK(n_steps > 0);
      CHECK(simulation->n_steps() == n_steps);
      CHECK(simulation->digest() == digest);
      CHECK(centre_of(simulation->report().bodies[0]) == centre_before);
      return error.what();
    }
  }
  return "nothing went wrong";
}

}  // namespace

TEST_CASE("two rigid bodies that meet end the run at the last good state")
{
  Scene scene = empty_scene(2, {24, 12, 1}, cell);
  scene.n_patches = {2, 1, 1};
  add_rigid_box(scene, 1000, {0.2, 0.2, 0}, {0.4, 0.4, 0}, {1, 0, 0});
  add_rigid_box(scene, 1000, {0.7, 0.2, 0}, {0.9, 0.4, 0}, {-1, 0, 0});

  CHECK_THAT(failure_of(scene), Catch::Contains("two rigid bodies meet"));
}

TEST_CASE("a rigid body that comes to an edge of the domain, open or a wall, ends the run at the last good state")
{
  const auto face = GENERATE(Face(components::OpenFace()), Face(components::SymmetryFace()));
  Scene scene = empty_scene(2, {12, 12, 1}, cell);
  scene.n_patches = {2, 2, 1};
  scene.faces[0] = {face, face};
  add_rigid_box(scene, 1000, {0.2, 0.2, 0}, {0.3, 0.3, 0}, {1, 0, 0});

  CHECK_THAT(failure_of(scene), Catch::Contains("reaches the edge of the domain"));
}

TEST_CASE("the first step is bounded by the fastest matter of a body that spins, rigid or not")
{
  const bool rigid = GENERATE(true, false);
  Scene scene = empty_scene(2, {16, 16, 1}, cell);
  scene.time.rule = StepRule::published;
  SceneBody& body = add_rigid_box(scene, 1000, {0.3, 0.3, 0}, {0.5, 0.5, 0}, {0, 0, 0});
  body.rigid = rigid;
  body.angular_velocity = {0, 0, 1e5};
  // Particles are half a cell wide.
  const double speed = 1e5 * (0.1 - cell / 4);
  const double wave_speed = rigid ? 0 : std::sqrt(uniaxial_modulus(1e9, 0.3) / 1000);

  const double bound = Simulation::make(scene, 1)->stable_step();

  CHECK(bound == Approx(cell / (wave_speed + speed)).epsilon(1e-12));
}

TEST_CASE("the first step lets bodies that spin towards each other close a tenth of a cell")
{
  Scene scene = empty_scene(2, {16, 16, 1}, cell);
  add_rigid_box(scene, 1000, {0.15, 0.3, 0}, {0.35, 0.5, 0}, {3, 0, 0}).angular_velocity = {0, 0, 100};
  add_rigid_box(scene, 1000, {0.45, 0.3, 0}, {0.65, 0.5, 0}, {-1, 0, 0});

  const double bound = Simulation::make(scene, 1)->stable_step();

  const double turning = 100 * (0.1 - cell / 4);
  CHECK(bound == Approx(0.1 * cell / std::hypot(4 + turning, turning)).epsilon(1e-12));
}

TEST_CASE("a rigid body that spins too fast to be followed is a failure of the simulation")
{
  const components::MassProperties body = components::mass_properties(
      std::vector<double>{1, 1}, std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}}, 1, false);
  ContactImpulses::Impulse impulse;
  impulse.angular = {0, 1e12, 0};

  CHECK_THROWS_AS(moved(body, {}, impulse, components::nothing_held, 0.1), SimulationError);
}

}  // namespace test_rigid_body
