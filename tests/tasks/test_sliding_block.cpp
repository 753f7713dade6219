#include <catch2/catch.hpp>

#include "tests/tasks/scenes.hpp"

namespace test_sliding_block
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double g = 10;

/// A block of 0.4 m x 0.1 m slides at 1 m/s on a slab between smooth walls.
Scene sliding_block(double friction, const components::ContactNormal& normal = components::FlatterNormal())
{
  constexpr int n_per_metre = 40;
  Scene scene = empty_scene(2, {n_per_metre, n_per_metre / 2, 1}, 1.0 / n_per_metre);
  scene.faces[0] = {components::SymmetryFace(), components::SymmetryFace()};
  scene.faces[1] = {components::SymmetryFace(), components::OpenFace()};
  scene.gravity = {0, -g, 0};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.time.multiplier = 0.8;
  const int ground = add_elastic(scene, 2000, 1e7, 0.2), block = add_elastic(scene, 2000, 1e7, 0.2);
  add_box(scene, ground, {0, 0, 0}, {1, 0.1, 0});
  add_box(scene, block, {0.2, 0.1, 0}, {0.6, 0.2, 0}, {1, 0, 0});
  scene.contacts.push_back({ground, block, friction, normal});
  return scene;
}

/// How far the block has come [m].
double way(Simulation& simulation)
{
  const BodySums block = simulation.report().bodies[1];
  return (block.position[0] - block.reference_position[0]) / block.mass;
}

}  // namespace

TEST_CASE("without friction a block slides on at its speed")
{
  const auto simulation = Simulation::make(sliding_block(0), 2);

  advance_to(*simulation, 0.2);

  CHECK(way(*simulation) == Approx(0.2).epsilon(0.01));
}

TEST_CASE("friction stops a block after the way that Coulomb's law gives it", "[slow]")
{
  const double friction = 0.3, stop = 1 / (friction * g);
  const auto normal = GENERATE(components::ContactNormal(components::FlatterNormal()),
                               components::ContactNormal(components::RegressionNormal()));
  const auto simulation = Simulation::make(sliding_block(friction, normal), 2);

  advance_to(*simulation, 0.5 * stop);
  CHECK(way(*simulation) == Approx(0.375 * stop).epsilon(0.02));
  advance_to(*simulation, stop);
  CHECK(way(*simulation) == Approx(0.5 * stop).epsilon(0.02));
}

TEST_CASE("local damping adds its part to the friction of a wall, and more on ground that vibrates", "[slow]")
{
  const double friction = 0.3, damping = 0.3, stop = 1 / ((1 + damping) * friction * g);
  Scene on_ground = sliding_block(friction);
  on_ground.local_damping = damping;
  Scene on_wall = on_ground;
  on_wall.faces[1][0] = components::RoughWall{friction};
  on_wall.bodies[0].solid = components::Solid<2>(components::Box<2>{{0.9, 0}, {1, 0.1}});  // out of the way
  on_wall.bodies[1].solid = components::Solid<2>(components::Box<2>{{0.2, 0}, {0.6, 0.1}});
  const auto along_wall = Simulation::make(on_wall, 2), along_ground = Simulation::make(on_ground, 2);

  advance_to(*along_wall, stop);
  advance_to(*along_ground, stop);

  CHECK(way(*along_wall) == Approx(0.5 * stop).epsilon(0.005));
  CHECK(way(*along_ground) < 0.5 * stop);
  CHECK(way(*along_ground) > 0.9 * 0.5 * stop);
}

TEST_CASE("a block that friction has stopped stays where it is", "[slow]")
{
  const auto simulation = Simulation::make(sliding_block(0.3), 2);
  advance_to(*simulation, 0.4);
  const double stopped = way(*simulation);

  advance_to(*simulation, 0.6);

  // A hundredth of a cell.
  CHECK(way(*simulation) == Approx(stopped).margin(0.01 / 40));
}

}  // namespace test_sliding_block
