#include <catch2/catch.hpp>

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "components/errors.hpp"
#include "tests/components/materials/concrete_sand.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_settled_ground
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double density = 1624;
constexpr double height = 0.107;
constexpr int n_steps = TAMP_SANITIZED ? 30 : 300;

/// Sand in a box with 5 mm cells, its surface within a cell and its top open; the last axis is the vertical.
Scene box_of_sand(int dimension, components::ElasticUpdate form = components::ElasticUpdate::state)
{
  Scene scene = empty_scene(dimension, {6, dimension == 2 ? 26 : 4, dimension == 3 ? 26 : 1}, 0.005);
  const std::size_t vertical = dimension == 2 ? 1 : 2;
  for (std::size_t axis = 0; axis < vertical; ++axis) add_walls(scene, axis);
  scene.faces[vertical] = {components::SymmetryFace(), components::OpenFace()};
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.materials.push_back({"sand", density, concrete_sand::sand(form)});
  Triple upper{0.03, 0.02, height};
  if (dimension == 2) upper[1] = height;
  add_box(scene, 0, {0, 0, 0}, upper).initial_stress = true;
  return scene;
}

Scene sand_in_centrifuge(const Eigen::Vector3d& axis = {1, 0, 0})
{
  Scene scene = box_of_sand(3);
  scene.n_patches = {1, 1, 2};
  scene.centrifuge.emplace(6, axis, Eigen::Vector3d(0.015, 0.01, 5.45));
  return scene;
}

Scene sand_under_gravity(components::ElasticUpdate form = components::ElasticUpdate::state)
{
  Scene scene = box_of_sand(2, form);
  scene.gravity = {0, -9.81, 0};
  return scene;
}

/// Young's modulus 20 GPa, Poisson's ratio 0.25.
components::DruckerPrager rock(double friction = 40, double cohesion = 1e6)
{
  return {.bulk_modulus = 13.333e9, .shear_modulus = 8e9, .friction_angle = friction, .cohesion = cohesion};
}

/// Rock of 100 m in cells of 10 m, in bodies one on another: the height to which each reaches and its material.
Scene rock_under_gravity(int dimension, const std::vector<std::pair<double, SceneMaterial>>& strata)
{
  Scene scene = empty_scene(dimension, {4, dimension == 2 ? 12 : 3, dimension == 3 ? 12 : 1}, 10);
  const auto vertical = static_cast<std::size_t>(dimension - 1);
  for (std::size_t axis = 0; axis < vertical; ++axis) add_walls(scene, axis);
  scene.faces[vertical] = {components::SymmetryFace(), components::OpenFace()};
  scene.gravity[vertical] = -9.81;
  double floor = 0;
  for (const auto& [top, material] : strata) {
    Triple lower{0, 0, 0}, upper{40, 30, 30};
    lower[vertical] = std::exchange(floor, top);
    upper[vertical] = top;
    scene.materials.push_back(material);
    add_box(scene, static_cast<int>(scene.materials.size()) - 1, lower, upper).initial_stress = true;
  }
  return scene;
}

/// The fastest particle after some steps, over the speed of a free fall that long.
double part_of_fall(const Scene& scene)
{
  const auto simulation = Simulation::make(scene, 2);
  for (int i = 0; i < n_steps / 3; ++i) simulation->advance(1e6);
  double speed = 0;
  for (const Particle& particle : particles_of(*simulation)) speed = std::max(speed, particle.velocity.norm());
  return speed / (9.81 * simulation->time());
}

double fastest(Simulation& simulation)
{
  double speed = 0;
  for (const Particle& particle : particles_of(simulation)) speed = std::max(speed, particle.velocity.norm());
  return speed;
}

}  // namespace

TEST_CASE("settled sand stays at rest in a centrifuge and under gravity", "[slow]")
{
  const bool turns = GENERATE(true, false);
  Scene scene = turns ? sand_in_centrifuge() : sand_under_gravity();
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const auto simulation = Simulation::make(scene, 2);

  for (int i = 0; i < n_steps; ++i) simulation->advance(1);

  CAPTURE(fastest(*simulation), simulation->time());
  CHECK(fastest(*simulation) < 1e-12);
  CHECK(simulation->time() > n_steps * 1e-4 / 300);
}

TEST_CASE("settled sand stays at rest on rough walls that it touches at its edges, which take no energy")
{
  const int dimension = GENERATE(2, 3);
  const auto vertical = static_cast<std::size_t>(dimension - 1);
  Scene scene = box_of_sand(dimension);
  scene.gravity[vertical] = -9.81;
  for (std::size_t axis = 0; axis < vertical; ++axis) scene.faces[axis].fill(components::RoughWall{0.3, true});
  scene.faces[vertical][0] = components::RoughWall{0.3, true};
  const auto simulation = Simulation::make(scene, 2);

  for (int i = 0; i < n_steps; ++i) simulation->advance(1);

  CAPTURE(dimension);
  CHECK(fastest(*simulation) < 1e-12);
  CHECK(std::abs(simulation->energies().contact) < 1e-20);
}

TEST_CASE("settled sand that fills a periodic domain from side to side stays at rest", "[slow]")
{
  Scene scene = box_of_sand(3);
  scene.gravity = {0, 0, -9.81};
  scene.grid.periodic[0] = true;
  scene.n_patches = {GENERATE(1, 2), 1, 1};
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  const auto simulation = Simulation::make(scene, 2);

  for (int i = 0; i < n_steps; ++i) simulation->advance(1);

  CHECK(fastest(*simulation) < 1e-12);
}

TEST_CASE("settled sand stays at rest in rate form too")
{
  const auto simulation = Simulation::make(sand_under_gravity(components::ElasticUpdate::rate), 1);

  for (int i = 0; i < n_steps; ++i) simulation->advance(1);

  CHECK(fastest(*simulation) < 1e-12);
}

TEST_CASE("settled sand carries the weight above it, and k0 of that, or an elastic share, to its sides")
{
  Scene scene = sand_in_centrifuge();
  scene.bodies[0].k0 = GENERATE(std::optional<double>(), std::optional(0.5));
  const auto simulation = Simulation::make(scene, 1);

  for (const Particle& particle : particles_of(*simulation)) {
    // The lattice fills the surface's cell up to half, 0.1075 m.
    const double z = particle.position[2], top = 0.1075;
    const double weight = density * 36 * (top - z) * (5.45 - 0.5 * (top + z));
    REQUIRE(-particle.stress[2] == Approx(weight).epsilon(1e-2).margin(200));
    REQUIRE(particle.stress[0] ==
            Approx(scene.bodies[0].k0.value_or(0.189 / 0.811) * particle.stress[2]).epsilon(1e-9).margin(1e-9));
    REQUIRE(particle.stress[3] == 0);
    REQUIRE(particle.volume_ratio == 1);
  }
}

TEST_CASE("rock carries the weight above it, k0 of that across, and stays at rest")
{
  const int dimension = GENERATE(2, 3);
  const std::optional<double> k0 = GENERATE(std::optional<double>(), std::optional(0.8), std::optional(1.4));
  const MaterialModel model = GENERATE(MaterialModel(rock()), MaterialModel(components::Hypoelastic{13.333e9, 8e9}));
  Scene scene = rock_under_gravity(dimension, {{100, {"rock", 2650, model}}});
  scene.bodies[0].k0 = k0;
  const double nu = (3 * 13.333e9 - 2 * 8e9) / (2 * (3 * 13.333e9 + 8e9));

  for (const Particle& particle : particles_of(*Simulation::make(scene, 1))) {
    const double weight = 2650 * 9.81 * (100 - particle.position[dimension - 1]);
    const auto& s = particle.stress;
    REQUIRE(s[static_cast<std::size_t>(dimension - 1)] == Approx(-weight).epsilon(1e-12));
    REQUIRE(s[0] == Approx(-k0.value_or(nu / (1 - nu)) * weight).epsilon(1e-12));
    REQUIRE(s[dimension == 2 ? 2 : 1] == s[0]);
    REQUIRE((s[3] == 0 && s[4] == 0 && s[5] == 0));
  }
  CHECK(part_of_fall(scene) < 1e-11);
}

TEST_CASE("strata carry the weight of those above, whatever their densities and materials, and stay at rest")
{
  const int dimension = GENERATE(2, 3);
  // At a node of the grid, and between two.
  const double middle = GENERATE(40, 45);
  Scene scene = rock_under_gravity(dimension, {{middle, {"dense", 2650, rock()}},
                                               {middle + 30, {"loose", 1600, components::Hypoelastic{1e8, 6e7}}},
                                               {100, {"clay", 2000, rock(0, 1e6)}}});
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  std::swap(scene.bodies[0], scene.bodies[2]);
  CAPTURE(dimension, middle, scene.interpolator.word());

  for (const Particle& particle : particles_of(*Simulation::make(scene, 1))) {
    const double z = particle.position[dimension - 1];
    const double weight = 9.81 * (2650 * std::max(middle - z, 0.0) + 1600 * std::clamp(middle + 30 - z, 0.0, 30.0) +
                                  2000 * std::min(100 - z, 70 - middle));
    // Splines see the surface half a layer off; within the weight of a quarter of a cell.
    REQUIRE(-particle.stress[static_cast<std::size_t>(dimension - 1)] == Approx(weight).margin(2650 * 9.81 * 2.5));
  }
  CHECK(part_of_fall(scene) < 1e-11);
}

TEST_CASE("strata of sand whose contact has friction stay at rest in a centrifuge")
{
  Scene scene = sand_in_centrifuge();
  scene.materials.push_back({"looser", 1500, scene.materials[0].model});
  scene.bodies[0].solid = components::Solid<3>(components::Box<3>{{0, 0, 0}, {0.03, 0.02, 0.06}});
  add_box(scene, 1, {0, 0, 0.06}, {0.03, 0.02, height}).initial_stress = true;
  scene.contacts.push_back({0, 1, 0.5});

  CHECK(part_of_fall(scene) < 1e-11);
}

TEST_CASE("strata of one density have the stress of one body, to the last bit")
{
  const SceneMaterial soil{"soil", 2000, rock()};
  const auto stresses = [](const Scene& scene) {
    std::map<std::pair<double, double>, std::array<double, 6>> by_place;
    for (const Particle& p : particles_of(*Simulation::make(scene, 1))) {
      by_place[{p.position[0], p.position[1]}] = p.stress;
    }
    return by_place;
  };

  CHECK(stresses(rock_under_gravity(2, {{100, soil}})) == stresses(rock_under_gravity(2, {{45, soil}, {100, soil}})));
}

TEST_CASE("sand without its initial stress does not stay at rest")
{
  Scene scene = sand_under_gravity();
  scene.bodies[0].initial_stress = false;
  const auto simulation = Simulation::make(scene, 1);

  for (int i = 0; i < n_steps; ++i) simulation->advance(1);

  CHECK(fastest(*simulation) > 1e-6);
}

TEST_CASE("sand that cannot have settled is refused")
{
  CHECK_THROWS_AS(Simulation::make(sand_in_centrifuge({1, 1, 0}), 1), components::BadValue);

  Scene upwards = sand_under_gravity();
  // More than its cohesion holds.
  upwards.gravity[1] = 1e5;
  CHECK_THROWS_AS(Simulation::make(upwards, 1), components::BadValue);

  Scene open_side = sand_under_gravity();
  open_side.faces[0][1] = components::OpenFace();
  CHECK_THROWS_AS(Simulation::make(open_side, 1), components::BadValue);

  Scene without_sides = sand_under_gravity();
  without_sides.grid.periodic[0] = true;
  without_sides.gravity[0] = 0.1;
  CHECK_THROWS_AS(Simulation::make(without_sides, 1), components::BadValue);

  Scene thin = rock_under_gravity(
      2, {{60, {"rock", 2650, rock()}}, {80, {"seam", 1400, rock()}}, {100, {"roof", 2650, rock()}}});
  CHECK_NOTHROW(Simulation::make(thin, 1));
  thin.interpolator = "quadratic_spline";
  CHECK_THROWS_AS(Simulation::make(thin, 1), components::BadValue);

  const SceneMaterial rubber{"rubber", 1000, components::NeoHookean{1e6, 1e6}};
  CHECK_THROWS_AS(Simulation::make(rock_under_gravity(2, {{100, rubber}}), 1), components::BadValue);
}

}  // namespace test_settled_ground
