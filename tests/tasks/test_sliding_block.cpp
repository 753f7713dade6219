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
Scene sliding_block(double friction, int normal_of = components::ContactTable::flatter)
{
  constexpr int n_per_metre = 40;
  Scene scene = empty_scene(2, {n_per_metre, n_per_metre / 2, 1}, 1.0 / n_per_metre);
  scene.faces[0] = {Face::symmetry, Face::symmetry};
  scene.faces[1] = {Face::symmetry, Face::open};
  scene.gravity = {0, -g, 0};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.time.multiplier = 0.8;
  const int ground = add_elastic(scene, 2000, 1e7, 0.2), block = add_elastic(scene, 2000, 1e7, 0.2);
  add_box(scene, ground, {0, 0, 0}, {1, 0.1, 0});
  add_box(scene, block, {0.2, 0.1, 0}, {0.6, 0.2, 0}, {1, 0, 0});
  scene.contacts.push_back({ground, block, friction, normal_of});
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

TEST_CASE("friction stops a block after the way that Coulomb's law gives it")
{
  const double friction = 0.3, stop = 1 / (friction * g);
  const int normal_of = GENERATE(components::ContactTable::flatter, components::ContactTable::regression);
  const auto simulation = Simulation::make(sliding_block(friction, normal_of), 2);

  advance_to(*simulation, 0.5 * stop);
  CHECK(way(*simulation) == Approx(0.375 * stop).epsilon(0.02));
  advance_to(*simulation, stop);
  CHECK(way(*simulation) == Approx(0.5 * stop).epsilon(0.02));
}

TEST_CASE("local damping is a part of what friction leaves unbalanced, on the ground and on a wall")
{
  const double friction = 0.3, damping = GENERATE(0, 0.3), stop = 1 / ((1 + damping) * friction * g);
  const bool on_wall = GENERATE(false, true);
  Scene scene = sliding_block(friction);
  scene.local_damping = damping;
  if (on_wall) {
    scene.faces[1][0] = Face::friction;
    scene.wall_friction[1][0] = friction;
    scene.bodies[0].solid = components::Solid<2>(components::Box<2>{{0.9, 0}, {1, 0.1}});  // out of the way
    scene.bodies[1].solid = components::Solid<2>(components::Box<2>{{0.2, 0}, {0.6, 0.1}});
  }
  const auto simulation = Simulation::make(scene, 2);

  advance_to(*simulation, stop);

  CAPTURE(damping, on_wall);
  CHECK(way(*simulation) == Approx(0.5 * stop).epsilon(0.03));
}

TEST_CASE("a block that friction has stopped stays where it is")
{
  const auto simulation = Simulation::make(sliding_block(0.3), 2);
  advance_to(*simulation, 0.4);
  const double stopped = way(*simulation);

  advance_to(*simulation, 0.6);

  // A hundredth of a cell.
  CHECK(way(*simulation) == Approx(stopped).margin(0.01 / 40));
}

}  // namespace test_sliding_block
