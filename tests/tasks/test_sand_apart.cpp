#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "tests/components/materials/concrete_sand.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_sand_apart
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// Sand that may separate, in a block that spins so fast that it does, while it flies; 4 patches.
Scene spinning_sand(int dimension)
{
  Scene scene = empty_scene(dimension, {20, 20, dimension == 3 ? 12 : 1}, 0.05);
  scene.n_patches = {2, 2, 1};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  auto parameters = concrete_sand::sand(components::ElasticUpdate::state).parameters();
  parameters.separation_density = 0.8;
  scene.materials.push_back({"sand", 1624, components::TabularCap(parameters)});
  add_box(scene, 0, {0.35, 0.4, 0.25}, {0.65, 0.6, 0.35}, {3, -1, 0}).angular_velocity = {0, 0, 100};
  return scene;
}

double sum(const std::vector<double>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

}  // namespace

TEST_CASE("sand that is thrown apart keeps its momentum and accounts for its energy, and flies on as it is", "[slow]")
{
  const int dimension = GENERATE(2, 3);
  Scene scene = spinning_sand(dimension);
  scene.transfer = GENERATE(Transfer("flip"), Transfer("tflip"));
  const auto simulation = Simulation::make(scene, 2);
  const ParticleReport before = simulation->report();
  const double stable_step = simulation->stable_step();

  advance_to(*simulation, 0.01);

  const ParticleReport after = simulation->report();
  const double given = simulation->energies().driving + before.kinetic;
  CHECK((after.momentum() - before.momentum()).norm() < 1e-12 * before.momentum().norm());
  CHECK(after.kinetic + worked(simulation->energies()) == Approx(given).epsilon(0.02));
  CHECK(simulation->lost().count == 0);
  const std::vector<double> apart = numbers_of(*simulation, "apart"), q = numbers_of(*simulation, "q"),
                            p = numbers_of(*simulation, "p");
  const auto n_apart = static_cast<std::size_t>(sum(apart));
  CHECK(n_apart > apart.size() / 2);
  CHECK(simulation->updates().separations >= n_apart);
  for (std::size_t i = 0; i < apart.size(); ++i) {
    if (apart[i] == 0) continue;
    REQUIRE(p[i] == 0);
    REQUIRE(q[i] == 0);
  }
  // Hardly any particle has stiffness any more.
  CHECK(simulation->stable_step() > 1.5 * stable_step);
}

TEST_CASE("the field K is the modulus that sand starts with, then that of its strain, and 0 where it has separated")
{
  const Scene scene = spinning_sand(2);
  const auto simulation = Simulation::make(scene, 2);
  const double initial = std::get<components::TabularCap>(scene.materials[0].model).initial_moduli().bulk_modulus;

  const std::vector<double> before = numbers_of(*simulation, "K");
  advance_to(*simulation, 0.01);
  const std::vector<double> after = numbers_of(*simulation, "K"), apart = numbers_of(*simulation, "apart");

  for (const double modulus : before) REQUIRE(modulus == initial);
  CHECK(sum(apart) > 0);
  for (std::size_t i = 0; i < after.size(); ++i) REQUIRE((after[i] == 0) == (apart[i] == 1));
  CHECK(*std::max_element(after.begin(), after.end()) > initial);
}

TEST_CASE("sand that is thrown apart gains no energy by gradients that come from nodes alone")
{
  Scene scene = spinning_sand(2);
  scene.transfer = GENERATE(Transfer("apic"), Transfer("tpic"));
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const auto simulation = Simulation::make(scene, 2);
  const ParticleReport before = simulation->report();

  advance_to(*simulation, 0.02);

  // The gradients of the block's spin are energy too, m omega^2 D, which reports do not count: D, the second moment of
  // weights along an axis, is at 1/4 and 3/4 of a cell 1/4 * 3/4 cells^2 where they are linear, and 1/4 for splines.
  const double moment = (scene.interpolator == Interpolator("gimp") ? 3.0 / 16 : 0.25) * 0.05 * 0.05;
  const double within = total_mass(before) * 100 * 100 * moment;
  const ParticleReport after = simulation->report();
  CAPTURE(before.kinetic, within, after.kinetic, worked(simulation->energies()));
  CHECK((after.momentum() - before.momentum()).norm() < 1e-12 * before.momentum().norm());
  CHECK(after.kinetic + worked(simulation->energies()) < before.kinetic + within);
  CHECK(sum(numbers_of(*simulation, "apart")) > 0);
}

TEST_CASE("sand that has separated joins where it is pushed together, on any threads alike")
{
  Scene scene = spinning_sand(2);
  for (std::size_t axis = 0; axis < 2; ++axis) add_walls(scene, axis);
  const auto simulation = Simulation::make(scene, 1), other = Simulation::make(scene, 2);
  const double given = simulation->report().kinetic;

  for (Simulation* one : {simulation.get(), other.get()}) advance_to(*one, 0.05);

  const double n_apart = sum(numbers_of(*simulation, "apart"));
  CHECK(static_cast<double>(simulation->updates().separations) > n_apart);
  CHECK(simulation->report().kinetic + worked(simulation->energies()) == Approx(given).epsilon(0.2));
  CHECK(simulation->updates().failures == 0);
  CHECK(simulation->digest() == other->digest());
}

TEST_CASE("soil that is thrown apart and falls together again does so on any threads alike, and loses energy alone")
{
  Scene scene = spinning_sand(2);
  const bool is_cone = GENERATE(true, false);
  components::DruckerPrager cone{.bulk_modulus = 20e6, .shear_modulus = 12e6, .friction_angle = 35};
  cone.separation = true;
  components::BoltonSand bolton{.grain_density = 2650,
                                .e_min = 0.55,
                                .e_max = 0.95,
                                .critical_friction_angle = 32,
                                .shear_modulus_number = 125,
                                .poissons_ratio = 0.05};
  bolton.fill(scene.materials[0].density);
  bolton.choose_strength(true);
  scene.materials[0].model = is_cone ? components::MaterialModel(cone) : components::MaterialModel(bolton);
  for (std::size_t axis = 0; axis < 2; ++axis) add_walls(scene, axis);
  const auto simulation = Simulation::make(scene, 1), other = Simulation::make(scene, 2);
  const double given = simulation->report().kinetic;

  for (Simulation* one : {simulation.get(), other.get()}) advance_to(*one, 0.05);

  CHECK(simulation->updates().separations > 50);
  CHECK(simulation->updates().apart > 1000);
  const EnergyLedger& energies = simulation->energies();
  const double left = simulation->report().kinetic + worked(energies);
  CHECK(left < given);
  CHECK(left + energies.filter - energies.half_step == Approx(given).epsilon(0.01));
  CHECK(simulation->updates().failures == 0);
  CHECK(simulation->digest() == other->digest());
}

TEST_CASE("a block of dry soil that is dropped keeps its volume where its grains may part, and swells where not")
{
  Scene scene = empty_scene(2, {16, 12, 1}, 0.025);
  scene.gravity = {0, -9.81, 0};
  scene.transfer = Transfer("apic");
  scene.artificial_viscosity = components::ArtificialViscosity{};
  for (std::size_t axis = 0; axis < 2; ++axis) add_walls(scene, axis);
  add_box(scene, 0, {0.1, 0.025, 0}, {0.3, 0.125, 0}, {0, -1, 0});
  const auto mean_volume = [&](bool separation) {
    components::DruckerPrager soil{.bulk_modulus = 1e6, .shear_modulus = 6e5, .friction_angle = 35};
    soil.separation = separation;
    scene.materials = {{"soil", 1600, soil}};
    const auto simulation = Simulation::make(scene, 2);
    advance_to(*simulation, 0.6);
    const std::vector<double> volume = numbers_of(*simulation, "J");
    return sum(volume) / static_cast<double>(volume.size());
  };

  CHECK(mean_volume(true) == Approx(1).margin(0.03));
  CHECK(mean_volume(false) > 1.1);
}

}  // namespace test_sand_apart
