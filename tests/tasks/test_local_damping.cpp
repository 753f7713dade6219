#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tasks/scenes.hpp"

namespace test_local_damping
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double height = 1, density = 1000, gravity = 10;

/// An elastic column between smooth walls on a floor, on which gravity acts from one moment on.
Scene heavy_column(double damping)
{
  Scene scene = empty_scene(2, {4, 16, 1}, 0.1);
  scene.n_patches = {1, 4, 1};
  add_walls(scene, 0);
  scene.faces[1][0] = components::SymmetryFace();
  scene.gravity = {0, -gravity, 0};
  scene.local_damping = damping;
  add_box(scene, add_elastic(scene, density, 1e6, 0.25), {0, 0, 0}, {0.4, height, 0});
  return scene;
}

}  // namespace

TEST_CASE("a damped column comes to rest under its weight, and one that is not damped swings on")
{
  const auto damped = Simulation::make(heavy_column(0.3), 1), swinging = Simulation::make(heavy_column(0), 1);
  const double period = 4 * height / std::sqrt(uniaxial_modulus(1e6, 0.25) / density);

  advance_to(*damped, 10 * period);
  advance_to(*swinging, 10.25 * period);

  CHECK(damped->report().kinetic < 1e-6 * swinging->report().kinetic);
  // The two layers of particles of a cell have one stress, that of its middle.
  std::array<double, 10> stress{}, y{};
  for (const Particle& p : particles_of(*damped)) {
    const auto layer = static_cast<std::size_t>(p.position.y() / 0.1);
    stress[layer] += p.stress[1] / 16;
    y[layer] += p.position.y() / 16;
  }
  for (std::size_t layer = 0; layer < 10; ++layer) {
    const double expected = -density * gravity * (height - y[layer]);
    CHECK(stress[layer] == Approx(expected).margin(0.01 * density * gravity * height));
  }
}

TEST_CASE("what local damping takes is what the swinging loses")
{
  const auto simulation = Simulation::make(heavy_column(0.3), 1);
  const double before = simulation->report().gravity_work;

  advance_to(*simulation, 3);

  const ParticleReport report = simulation->report();
  const double given = report.gravity_work - before;
  CHECK(simulation->energies().viscous > 0.3 * given);
  CHECK(report.kinetic + worked(simulation->energies()) == Approx(given).epsilon(0.01));
}

}  // namespace test_local_damping
