#include <catch2/catch.hpp>

#include "tests/tasks/scenes.hpp"

namespace test_plane_strain
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A box hits a block off its middle, with friction and gravity; in the plane, or as a slab of `n_layers` cells between
/// smooth walls.
Scene glancing_blow(int dimension, int n_layers, Interpolator interpolator)
{
  constexpr double h = 0.05;
  Scene scene = empty_scene(dimension, {16, 12, dimension == 3 ? n_layers : 1}, h);
  scene.n_patches = {2, 2, 1};
  scene.interpolator = interpolator;
  scene.gravity = {0, -10, 0};
  scene.faces[0] = {components::SymmetryFace(), components::OpenFace()};
  scene.faces[1] = {components::SymmetryFace(), components::OpenFace()};
  if (dimension == 3) add_walls(scene, 2);
  scene.artificial_viscosity = components::ArtificialViscosity{};
  // The viscous rule would see the corners of the slab.
  scene.time.rule = StepRule::published;
  scene.time.multiplier = 0.3;
  const int block = add_elastic(scene, 1000, 1e6, 0.3), striker = add_elastic(scene, 2000, 2e6, 0.2);
  add_box(scene, block, {0, 0, 0}, {0.5, 0.2, 1});
  add_box(scene, striker, {0.225, 0.225, 0}, {0.375, 0.4, 1}, {3, -5, 0});
  scene.contacts.push_back({block, striker, 0.3});
  return scene;
}

}  // namespace

TEST_CASE("a slab between smooth walls does what plane strain does")
{
  const int n_layers = GENERATE(1, 2);
  // Splines reach beyond both walls of a slab one cell thick.
  const auto interpolator = GENERATE(Interpolator("gimp"), Interpolator("cubic_spline"));
  const auto plane = Simulation::make(glancing_blow(2, n_layers, interpolator), 1);
  const auto slab = Simulation::make(glancing_blow(3, n_layers, interpolator), 2);

  for (int i = 0; i < 80; ++i) {
    plane->advance(1e30);
    slab->advance(1e30);
    REQUIRE(slab->last_step_size() == Approx(plane->last_step_size()).epsilon(1e-10));
  }

  auto in_plane = particles_of(*plane), in_slab = particles_of(*slab);
  const std::size_t n_in_depth = 2 * static_cast<std::size_t>(n_layers);
  REQUIRE(in_slab.size() == n_in_depth * in_plane.size());
  const auto before = [](const Particle& a, const Particle& b) {
    return std::array{a.material + 0.0, std::round(a.position[0] * 1e7), std::round(a.position[1] * 1e7)} <
           std::array{b.material + 0.0, std::round(b.position[0] * 1e7), std::round(b.position[1] * 1e7)};
  };
  std::sort(in_plane.begin(), in_plane.end(), before);
  std::sort(in_slab.begin(), in_slab.end(), before);
  double highest_stress = 0;
  for (const Particle& p : in_plane) highest_stress = std::max(highest_stress, std::abs(p.stress[1]));
  REQUIRE(highest_stress > 1e4);
  for (std::size_t i = 0; i < in_slab.size(); ++i) {
    const Particle &a = in_plane[i / n_in_depth], &b = in_slab[i];
    REQUIRE((a.position - b.position).head<2>().norm() < 1e-10);
    REQUIRE((a.velocity - b.velocity).norm() < 1e-10 * 5);
    for (std::size_t k = 0; k < 6; ++k) REQUIRE(std::abs(a.stress[k] - b.stress[k]) < 1e-10 * highest_stress);
  }
  const double depth = 0.05 * n_layers;
  CHECK(slab->energies().contact == Approx(depth * plane->energies().contact).epsilon(1e-9));
  CHECK(slab->energies().elastic == Approx(depth * plane->energies().elastic).epsilon(1e-9));
  CHECK(slab->grid_totals().impulse[1] == Approx(depth * plane->grid_totals().impulse[1]).epsilon(1e-9));
  CHECK(std::abs(slab->grid_totals().impulse[2]) < 1e-10 * slab->grid_totals().impulse[1]);
}

}  // namespace test_plane_strain
