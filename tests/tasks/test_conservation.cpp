#include <catch2/catch.hpp>

#include "tests/components/materials/concrete_sand.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_conservation
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A fast block hits one that rests, off its middle, with friction and viscosity, free of walls.
Scene collision(int dimension)
{
  constexpr double h = 0.05;
  Scene scene = empty_scene(dimension, {16, 12, dimension == 3 ? 8 : 1}, h);
  scene.n_patches = {2, 3, 1};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  const int a = add_elastic(scene, 1000, 1e6, 0.3), b = add_elastic(scene, 3000, 5e6, 0.2);
  add_box(scene, a, {0.1, 0.2, 0.1}, {0.35, 0.45, 0.3}, {6, 1, 0.5});
  add_box(scene, b, {0.4, 0.1, 0.1}, {0.6, 0.3, 0.3}, {0, 0, 0});
  scene.contacts.push_back({a, b, 0.3});
  return scene;
}

/// A rigid block hits two soft ones, which lie side by side and rub on each other, at the joint between them.
Scene squeeze()
{
  Scene scene = empty_scene(2, {20, 20, 1}, 0.05);
  scene.n_patches = {2, 2, 1};
  const int left = add_elastic(scene, 1000, 1e6, 0.3), right = add_elastic(scene, 2000, 2e6, 0.2),
            steel = add_elastic(scene, 8000, 1e9, 0.3);
  add_box(scene, left, {0.2, 0.2, 0}, {0.5, 0.5, 0});
  add_box(scene, right, {0.5, 0.2, 0}, {0.8, 0.45, 0});
  add_box(scene, steel, {0.4, 0.55, 0}, {0.6, 0.7, 0}, {1, -5, 0}).rigid = true;
  scene.contacts = {{left, right, 0.2}, {left, steel, 0.3}, {right, steel, 0.1}};
  return scene;
}

/// A punch of steel goes into sand in its own weight; half of both, at a mirror.
Scene punch()
{
  constexpr double h = 0.02;
  Scene scene = empty_scene(2, {12, 12, 1}, h);
  scene.n_patches = {3, 2, 1};
  scene.faces[0] = {components::SymmetryFace(), components::SymmetryFace()};
  scene.faces[1] = {components::SymmetryFace(), components::OpenFace()};
  scene.gravity = {0, -200, 0};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.materials.push_back({"sand", 1624, concrete_sand::sand(components::ElasticUpdate::state)});
  const int steel = add_elastic(scene, 7800, 2e10, 0.3);
  add_box(scene, 0, {0, 0, 0}, {1, 0.14, 0});
  add_box(scene, steel, {0, 0.15, 0}, {0.06, 0.21, 0}, {0, -100, 0});
  scene.contacts.push_back({0, steel, 0.3});
  return scene;
}

}  // namespace

TEST_CASE("bodies that collide in free space keep their mass and momentum")
{
  const int dimension = GENERATE(2, 3);
  Scene scene = collision(dimension);
  scene.transfer = GENERATE(Transfer("flip"), Transfer("pic"), Transfer("blend"), Transfer("tflip"), Transfer("apic"),
                            Transfer("tpic"), Transfer("xpic"), Transfer("fmpm"));
  scene.transfer_numbers.filter_order = 3;
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const auto simulation = Simulation::make(scene, 2);
  const ParticleReport before = simulation->report();

  // Steps of FMPM are shorter by the root of its order.
  const int n_steps = scene.transfer == Transfer("fmpm") ? 260 : 150;
  for (int i = 0; i < n_steps; ++i) {
    simulation->advance(1e30);
    const ParticleReport now = simulation->report();
    REQUIRE((now.momentum() - before.momentum()).norm() < 1e-12 * before.momentum().norm());
    REQUIRE(total_mass(now) == Approx(total_mass(before)).epsilon(1e-14));
  }

  // They did meet: the second has taken more than half of the momentum along x.
  const ParticleReport after = simulation->report();
  CHECK(after.bodies[1].momentum[0] > 0.5 * before.momentum()[0]);
  CHECK(simulation->energies().contact > 0);
  CHECK(simulation->energies().viscous > 0);
  const std::array<double, 3>& impulse = simulation->grid_totals().impulse;
  for (const double value : impulse) CHECK(std::abs(value) < 1e-12 * before.momentum().norm());
}

TEST_CASE("contact of three bodies, one of them rigid, gives impulses that sum to zero and are what each gains")
{
  const auto simulation = Simulation::make(squeeze(), 2);
  const ParticleReport before = simulation->report();

  for (int i = 0; i < 200; ++i) simulation->advance(1e30);

  const ParticleReport after = simulation->report();
  const std::vector<ContactForce> forces = simulation->take_mean_forces().contact;
  const double size = before.bodies[2].momentum.norm();
  const double span = simulation->time() - 0.5 * simulation->last_step_size();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t b = 0; b < forces.size(); ++b) {
    const Eigen::Vector3d impulse = span * forces[b].force;
    CHECK((after.bodies[b].momentum - before.bodies[b].momentum - impulse).norm() < 1e-12 * size);
    CHECK(impulse.norm() > 0.01 * size);
    sum += impulse;
  }
  CHECK(sum.norm() < 1e-12 * size);
}

TEST_CASE("what walls and gravity give is what the particles have gained")
{
  Scene scene = punch();
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"), Transfer("apic"), Transfer("xpic"), Transfer("fmpm"));
  const auto simulation = Simulation::make(scene, 2);
  const ParticleReport before = simulation->report();

  const int n_steps = scene.transfer == Transfer("fmpm") ? 142 : 100;
  for (int i = 0; i < n_steps; ++i) simulation->advance(1e30);

  const Eigen::Vector3d gained = simulation->report().momentum() - before.momentum();
  const Eigen::Vector3d given = Eigen::Map<const Eigen::Vector3d>(simulation->grid_totals().impulse.data());
  const double size = before.momentum().norm();
  CHECK(given[1] > 0.01 * size);
  CHECK((gained - given).norm() < 1e-12 * size);
  // The sand has yielded.
  const auto most_compacted = components::TabularCap::extremes()[1];
  CHECK(simulation->report().materials[0].extreme(1, most_compacted) > 0.01);
}

TEST_CASE("what falls out of the domain takes just the momentum that gravity gave it")
{
  Scene scene = empty_scene(2, {12, 12, 1}, 0.1);
  scene.n_patches = {2, 2, 1};
  scene.gravity = {1, -10, 0};
  const int soft = add_elastic(scene, 1000, 1e5, 0.3);
  add_box(scene, soft, {0.3, 0.2, 0}, {0.9, 0.6, 0}, {1, -1, 0}).angular_velocity = {0, 0, 5};
  const auto simulation = Simulation::make(scene, 2);
  const Eigen::Vector3d before = simulation->report().momentum();

  advance_to(*simulation, 0.2);

  REQUIRE(simulation->lost().count > 0);
  REQUIRE(simulation->report().bodies[0].mass > 0);
  const Eigen::Vector3d gained = simulation->report().momentum() + simulation->lost().momentum - before;
  const Eigen::Vector3d given = Eigen::Map<const Eigen::Vector3d>(simulation->grid_totals().impulse.data());
  CHECK((gained - given).norm() < 1e-12 * before.norm());
}

TEST_CASE("a run is the same, bit by bit, on any number of threads")
{
  const auto digest = [](int n_threads) {
    const auto simulation = Simulation::make(punch(), n_threads);
    for (int i = 0; i < 60; ++i) simulation->advance(1e30);
    return simulation->digest() + " " + std::to_string(simulation->energies().plastic);
  };

  const std::string one = digest(1);

  CHECK(digest(1) == one);
  CHECK(digest(2) == one);
  CHECK(digest(3) == one);
}

TEST_CASE("the digest sees the smallest change of a velocity")
{
  Scene scene = punch();
  const std::string digest = Simulation::make(scene, 1)->digest();
  scene.bodies[1].velocity[1] = std::nextafter(scene.bodies[1].velocity[1], 0);

  CHECK(Simulation::make(scene, 1)->digest() != digest);
}

}  // namespace test_conservation
