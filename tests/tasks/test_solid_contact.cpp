#include <catch2/catch.hpp>

#include "components/contact/contact_table.hpp"
#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_solid_contact
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double h = 0.05;

/// A rigid block of 0.3 m that runs at `speed` against a deformable one, `gap` apart along x. Its faces lie anywhere
/// between its particles.
Scene blocks(int dimension, double gap, double speed)
{
  Scene scene = empty_scene(dimension, {32, 12, dimension == 3 ? 12 : 1}, h);
  scene.time.multiplier = 0.5;
  const int rigid = add_elastic(scene, 1000, 1e5, 0.2), soft = add_elastic(scene, 1000, 1e5, 0.2);
  const double face = 0.65 - gap;
  add_box(scene, rigid, {face - 0.3, 0.143, 0.143}, {face, 0.443, 0.443}, {speed, 0, 0}).rigid = true;
  add_box(scene, soft, {0.65, 0.15, 0.15}, {0.95, 0.45, 0.45});
  scene.contacts.push_back({rigid, soft, 0.1, components::SolidNormal()});
  return scene;
}

double momentum(Simulation& simulation, std::size_t body)
{
  return simulation.report().bodies[body].momentum[0];
}

void drive(SceneBody& body, const Triple& velocity)
{
  body.velocity = velocity;
  body.drive = BodyDrive{components::PrescribedMotion::of_velocities({{0, Eigen::Vector3d(velocity.data())}}), false};
}

}  // namespace

TEST_CASE("by its solid a rigid body pushes from a tenth of a cell on, wherever its particles and the nodes are")
{
  const int dimension = GENERATE(2, 3);
  const double gap = GENERATE(1.3, 1.62) * h, speed = 0.5;
  Scene scene = blocks(dimension, gap, speed);
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"), Interpolator("cubic_spline"));
  const auto simulation = Simulation::make(scene, 2);

  double time = 0;
  while (momentum(*simulation, 1) == 0 && simulation->time() < 2 * gap / speed) {
    time = simulation->time();
    simulation->advance(1e30);
  }

  CHECK(std::abs(gap - speed * time) < 0.1 * h);
}

TEST_CASE("a rigid body that hits another by its solid keeps momentum and does not stick")
{
  const int dimension = GENERATE(2, 3);
  const auto simulation = Simulation::make(blocks(dimension, 0.3 * h, 0.5), 2);
  const double before = momentum(*simulation, 0);

  double most = 0;
  while (simulation->time() < 0.25) {
    simulation->advance(0.25);
    const double other = momentum(*simulation, 1);
    // No impulse ever pulls it back.
    CHECK(other > most - 1e-12 * before);
    most = std::max(most, other);
    REQUIRE(momentum(*simulation, 0) + other == Approx(before).epsilon(1e-12));
  }

  // All of it if none went into vibrations, half if the other stuck.
  CHECK(most > 0.7 * before);
}

TEST_CASE("what meets a driven body by its solid does not know how many particles the body has")
{
  const auto around = [](int particles_per_axis) {
    Scene scene = blocks(2, 0.3 * h, 0.5);
    drive(scene.bodies[0], {0.5, 0.2, 0});
    scene.materials[0].own_particles_per_axis = particles_per_axis;
    const auto simulation = Simulation::make(scene, 1);
    advance_to(*simulation, 0.1);
    return particles_of_material(particles_of(*simulation), 1);
  };

  const auto coarse = around(2), fine = around(5);

  REQUIRE(coarse.size() == fine.size());
  for (std::size_t p = 0; p < coarse.size(); ++p) {
    REQUIRE((coarse[p].position - fine[p].position).norm() < 1e-10 * h);
  }
  CHECK(coarse.front().position[0] > 0.66);
}

TEST_CASE("at 300 metres a second what meets a rigid body by its solid stays out of it")
{
  const int dimension = GENERATE(2, 3);
  Scene scene = blocks(dimension, 0.2 * h, 300);
  scene.materials[0].density = 5000;
  scene.materials[1].model = components::Hypoelastic{1e8, 5e7};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  const auto simulation = Simulation::make(scene, 2);
  const double face = dimension == 2 ? std::get<components::Solid<2>>(scene.bodies[0].solid).reach(Vector<2>::Unit(0))
                                     : std::get<components::Solid<3>>(scene.bodies[0].solid).reach(Vector<3>::Unit(0));

  double deepest = 0;
  while (simulation->time() < 3e-4) {
    simulation->advance(3e-4);
    const auto particles = particles_of(*simulation);
    const auto body = particles_of_material(particles, 0);
    const double moved = body.front().position[0] - particles_of(*Simulation::make(scene, 1)).front().position[0];
    for (const Particle& p : particles_of_material(particles, 1)) {
      if (std::abs(p.position[1] - 0.3) < h) deepest = std::max(deepest, face + moved - p.position[0]);
    }
  }
  CHECK(deepest == 0);
}

TEST_CASE("half of a rigid body beside a mirror is met by its solid as the whole is")
{
  const int dimension = GENERATE(2, 3);
  Scene whole = blocks(dimension, 0.3 * h, 0.5);
  // Shorter than their bound, which rounding changes where a particle only just reaches a node.
  whole.time.maximum_step = 5e-4;
  const components::Box<2> in_plane{{0.335, 0.15}, {0.635, 0.45}};
  const components::Box<3> in_space{{0.335, 0.15, 0.143}, {0.635, 0.45, 0.443}};
  whole.bodies[0].solid =
      dimension == 2 ? AnySolid(components::Solid<2>(in_plane)) : AnySolid(components::Solid<3>(in_space));
  Scene half = whole;
  half.grid.lower[1] = 0.3;
  half.grid.n_cells[1] = 6;
  half.faces[1][0] = components::SymmetryFace();
  const auto of_whole = Simulation::make(whole, 2), of_half = Simulation::make(half, 2);

  advance_to(*of_whole, 0.1);
  advance_to(*of_half, 0.1);

  const double expected = momentum(*of_whole, 1);
  CHECK(expected > 0);
  CHECK(2 * momentum(*of_half, 1) == Approx(expected).epsilon(1e-9));
}

TEST_CASE("what meets a rigid body by its solid ends with the same bits on any ranks and threads", "[ranks]")
{
  Scene scene = blocks(3, 0.3 * h, 0.5);
  scene.bodies[0].angular_velocity = {0.3, 0.4, 0.5};
  scene.n_patches = {4, 2, 1};
  const auto alone = Simulation::make(scene, 1);
  advance_to(*alone, 0.05);

  for (const int n_threads : {1, 2}) {
    const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()),
                                             runtime::Communicator::world());
    advance_to(*simulation, 0.05);
    CHECK(simulation->digest() == alone->digest());
    CHECK(simulation->take_mean_forces().contact[0].torque.norm() > 0);
  }
}

}  // namespace test_solid_contact
