#include <catch2/catch.hpp>

#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_free_flight
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A block of 4 x 4 x 4 cells that flies along the diagonal of a grid of 16 cells an axis, cut into patches.
Scene flying_block(int dimension, const Triple& velocity)
{
  Scene scene = empty_scene(dimension, {16, 16, dimension == 3 ? 16 : 1}, 0.05);
  scene.n_patches = {4, 2, 1};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  const int steel = add_elastic(scene, 7800, 2e5, 0.3);
  add_box(scene, steel, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, velocity);
  return scene;
}

}  // namespace

TEST_CASE("a body without forces flies on undeformed through cells and patches")
{
  const int dimension = GENERATE(2, 3);
  const int n_threads = GENERATE(1, 2);
  // Seven cells along x and a backward drift of half a cell along y; faster and slower than the body's waves.
  const double speed = GENERATE(1.0, 20.0);
  const Triple velocity{speed, -0.07 * speed, 0.9 * speed};
  Scene scene = flying_block(dimension, velocity);
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const auto simulation = Simulation::make(scene, n_threads);
  const auto before = particles_of(*simulation);
  const double mass = total_mass(simulation->report());

  advance_to(*simulation, end_of(0.35) / speed);

  Eigen::Vector3d v(velocity[0], velocity[1], dimension == 3 ? velocity[2] : 0);
  const auto after = particles_of(*simulation);
  REQUIRE(after.size() == before.size());
  for (std::size_t p = 0; p < after.size(); ++p) {
    REQUIRE((after[p].velocity - v).norm() < 1e-12 * speed);
    REQUIRE((after[p].position - before[p].position - v * simulation->time()).norm() < 1e-13);
    REQUIRE(std::abs(after[p].volume_ratio - 1) < 1e-12);
    // Round-off in strain times stiffness.
    for (const double s : after[p].stress) REQUIRE(std::abs(s) < 1e-11 * 2e5);
  }
  CHECK(total_mass(simulation->report()) == Approx(mass).epsilon(1e-14));
  CHECK(simulation->lost().count == 0);
  CHECK(simulation->n_steps() >= n_steps_of(6));
}

TEST_CASE("a body whose particles come to lie on the edges of cells flies on undeformed")
{
  constexpr double cell = 0.125;  // all places are exact
  const int dimension = GENERATE(2, 3);
  Scene scene = empty_scene(dimension, {16, 8, dimension == 3 ? 8 : 1}, cell);
  scene.particles_per_axis = 1;
  scene.interpolator = GENERATE(Interpolator("linear"), Interpolator("gimp"), Interpolator("quadratic_spline"));
  scene.time.rule = StepRule::published;
  scene.time.maximum_step = cell / 2;
  add_box(scene, add_elastic(scene, 1000, 90, 0), {2 * cell, 2 * cell, 2 * cell}, {4 * cell, 4 * cell, 4 * cell},
          {1, 1, dimension == 3 ? 1.0 : 0.0});
  const auto simulation = Simulation::make(scene, 1);

  for (int n = 0; n < 4; ++n) {
    simulation->advance(1e30);
    for (const Particle& p : particles_of(*simulation)) {
      REQUIRE(p.volume_ratio == Approx(1).epsilon(1e-14));
      for (const double s : p.stress) REQUIRE(std::abs(s) < 1e-12);
    }
  }
  CHECK(simulation->time() == 2 * cell);
}

TEST_CASE("a body in free fall follows its parabola exactly, whatever the sizes of its steps")
{
  Scene scene = flying_block(2, {2, 1, 0});
  scene.gravity = {0, -10, 0};
  const auto simulation = Simulation::make(scene, 1);
  const auto before = particles_of(*simulation);

  // Ends that are hit exactly make steps of many sizes. The first kick must be half a step for this to hold.
  for (const double end : {0.001, 0.0505, 0.051, 0.09, 0.2}) {
    advance_to(*simulation, end);

    const auto after = particles_of(*simulation);
    const Eigen::Vector3d way(2 * end, end - 5 * end * end, 0);
    for (std::size_t p = 0; p < after.size(); ++p) {
      REQUIRE((after[p].position - before[p].position - way).norm() < 1e-13);
    }
  }
  const double half_step = 0.5 * simulation->last_step_size();
  CHECK(particles_of(*simulation)[0].velocity[1] == Approx(1 - 10 * (0.2 - half_step)).epsilon(1e-12));
}

TEST_CASE("what leaves through open faces is counted with its mass and momentum")
{
  const int n_threads = GENERATE(1, 2);
  const auto simulation = Simulation::make(flying_block(2, {1, 0.5, 0}), n_threads);
  const double mass = total_mass(simulation->report());

  // The block's 8 columns of particles stand 0.025 m apart from x = 0.1125 m; after 0.6 s four have passed 0.8 m.
  advance_to(*simulation, 0.6);

  LostParticles lost = simulation->lost();
  CHECK(lost.count == 4 * 8);
  CHECK(lost.mass == Approx(mass / 2).epsilon(1e-13));
  CHECK(lost.momentum[0] == Approx(mass / 2).epsilon(1e-12));
  CHECK(lost.momentum[1] == Approx(mass / 4).epsilon(1e-12));
  const ParticleReport left = simulation->report();
  CHECK(simulation->n_particles(0) == 4 * 8);
  CHECK(total_mass(left) + lost.mass == Approx(mass).epsilon(1e-14));
  CHECK((left.momentum() + lost.momentum)[0] == Approx(mass).epsilon(1e-12));

  advance_to(*simulation, 1.0);

  lost = simulation->lost();
  CHECK(lost.count == 8 * 8);
  CHECK(simulation->n_particles(0) == 0);
  CHECK(lost.momentum[0] == Approx(mass).epsilon(1e-12));
}

}  // namespace test_free_flight
