#include <catch2/catch.hpp>

#include "components/contact/contact_table.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_parted_materials
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr components::FlatterNormal flatter;
constexpr components::RegressionNormal regression;
constexpr double h = 0.05;

/// Two blocks of 0.3 m, `gap` apart along x; the left one runs at `speed` against the right one, which rests.
Scene blocks(int dimension, double gap, double speed, const components::ContactNormal& normal)
{
  Scene scene = empty_scene(dimension, {32, 12, dimension == 3 ? 12 : 1}, h);
  scene.time.multiplier = 0.5;
  const int left = add_elastic(scene, 1000, 1e5, 0.2), right = add_elastic(scene, 1000, 1e5, 0.2);
  add_box(scene, left, {0.3, 0.15, 0.15}, {0.6, 0.45, 0.45}, {speed, 0, 0});
  add_box(scene, right, {0.6 + gap, 0.15, 0.15}, {0.9 + gap, 0.45, 0.45});
  scene.contacts.push_back({left, right, 0.1, normal});
  return scene;
}

double momentum(Simulation& simulation, std::size_t body)
{
  return simulation.report().bodies[body].momentum[0];
}

/// How far apart the blocks are, in cells, when the right one is first pushed.
double gap_at_first_push(int dimension, const components::ContactNormal& normal)
{
  const double gap = 2 * h, speed = 0.5;
  const auto simulation = Simulation::make(blocks(dimension, gap, speed, normal), 2);
  double time = 0;
  while (momentum(*simulation, 1) == 0 && simulation->time() < 2 * gap / speed) {
    time = simulation->time();
    simulation->advance(1e30);
  }
  return (gap - speed * time) / h;
}

/// The largest x of a material's particles whose y is within a cell of the middle.
double middle_end(Simulation& simulation, int material, double sign)
{
  double end = -std::numeric_limits<double>::infinity();
  for (const Particle& p : particles_of_material(particles_of(simulation), material)) {
    if (std::abs(p.position[1] - 0.3) < h) end = std::max(end, sign * p.position[0]);
  }
  return sign * end;
}

}  // namespace

TEST_CASE("with normals by regression bodies push each other when they touch, not from a cell away")
{
  const int dimension = GENERATE(2, 3);

  CHECK(gap_at_first_push(dimension, flatter) > 0.7);
  CHECK(std::abs(gap_at_first_push(dimension, regression)) < 0.2);
}

TEST_CASE("blocks that collide by regression rebound with their momentum and do not stick", "[slow]")
{
  const int dimension = GENERATE(2, 3);
  const auto simulation = Simulation::make(blocks(dimension, 0.3 * h, 0.5, regression), 2);
  const double before = momentum(*simulation, 0);

  double most = 0;
  while (simulation->time() < 0.25) {
    simulation->advance(0.25);
    const double right = momentum(*simulation, 1);
    // No impulse ever pulls it back.
    CHECK(right > most - 1e-12 * before);
    most = std::max(most, right);
    REQUIRE(momentum(*simulation, 0) + right == Approx(before).epsilon(1e-12));
  }

  CHECK(most > 0.8 * before);
}

TEST_CASE("blocks that touch and part feel nothing of each other")
{
  const auto simulation = Simulation::make(blocks(2, 0, -0.5, regression), 2);
  const double before = momentum(*simulation, 0);

  advance_to(*simulation, 0.1);

  CHECK(momentum(*simulation, 0) == Approx(before).epsilon(1e-12));
  CHECK(std::abs(momentum(*simulation, 1)) < 1e-12 * std::abs(before));
}

TEST_CASE("at 300 metres a second a rigid body enters another by less than a quarter of a cell")
{
  const int dimension = GENERATE(2, 3);
  Scene scene = blocks(dimension, 0.2 * h, 300, regression);
  scene.materials[0].density = 5000;
  scene.materials[1].model = components::Hypoelastic{1e8, 5e7};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.bodies[0].rigid = true;
  const auto simulation = Simulation::make(scene, 2);

  double overlap = 0;
  while (simulation->time() < 3e-4) {
    simulation->advance(3e-4);
    const double between = middle_end(*simulation, 1, -1) - middle_end(*simulation, 0, 1);
    overlap = std::max(overlap, (0.5 * h - between) / h);
  }

  CHECK(simulation->report().bodies[1].momentum[0] > 0);
  CHECK(overlap < 0.25);
}

TEST_CASE("a body beside a mirror meets another as the whole body does")
{
  Scene whole = blocks(2, 0.3 * h, 0.5, regression);
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

TEST_CASE("ground under two bodies that meet by regression is not pushed along with them")
{
  Scene scene = blocks(2, 0.3 * h, 0.5, regression);
  const int ground = add_elastic(scene, 1000, 1e5, 0.2);
  add_box(scene, ground, {0.1, 0.05, 0}, {1.2, 0.15, 0});
  const auto simulation = Simulation::make(scene, 2);
  const double before = momentum(*simulation, 0);

  advance_to(*simulation, 0.1);

  CHECK(momentum(*simulation, 1) > 0.5 * before);
  CHECK(std::abs(momentum(*simulation, 2)) < 1e-3 * before);
}

}  // namespace test_parted_materials
