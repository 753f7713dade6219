#include <catch2/catch.hpp>

#include <stdexcept>

#include "tests/components/materials/concrete_sand.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_sand_shock
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double density = 1624;
constexpr double speed = 200;
constexpr int n_cells = 100;
constexpr double h = 1.0 / n_cells;

/// Sand in uniaxial strain runs at a smooth wall at x = 0; it is 1 m long.
Scene sand_at_wall()
{
  Scene scene = empty_scene(2, {n_cells, 2, 1}, h);
  scene.faces[0] = {components::SymmetryFace(), components::OpenFace()};
  add_walls(scene, 1);
  // With the usual 0.2 and 2 particles ring behind the front, and sand that is squeezed beyond its state and let go
  // keeps the strain: its front is then 2 % slow.
  scene.artificial_viscosity = components::ArtificialViscosity{1, 4};
  scene.time.multiplier = 0.5;
  scene.materials.push_back({"sand", density, concrete_sand::sand(components::ElasticUpdate::state)});
  add_box(scene, 0, {0, 0, 0}, {1, 1e9, 0}, {-speed, 0, 0});
  return scene;
}

/// The state behind a shock that brings sand from `speed` to rest: the material's own stress in uniaxial strain, at the
/// compression where the jumps of mass and momentum ask for that stress.
struct Hugoniot {
  /// Pa, compression positive
  double stress;
  /// Ratio of the density behind the front to that ahead.
  double compression;
  /// Speed of the front into the sand ahead [m/s].
  double shock_speed;

  static Hugoniot of(const components::TabularCap& sand)
  {
    const double strain_step = 1e-5;
    SymmetricTensor<2> increment = SymmetricTensor<2>::Zero();
    increment[0] = -strain_step;
    concrete_sand::Sample<2> sample;
    for (double strain = strain_step; strain < 1; strain += strain_step) {
      sample.strain(sand, increment);
      const double shock_speed = speed / (1 - std::exp(-strain));
      // From infinity the stress that is asked for falls, and the material's rises.
      if (-sample.stress[0] >= density * shock_speed * speed) {
        return {-sample.stress[0], std::exp(strain), shock_speed};
      }
    }
    throw std::logic_error("no state behind the shock");
  }
};

}  // namespace

TEST_CASE("sand that runs at a wall at 200 m/s is shocked to its Hugoniot state")
{
  const Hugoniot expected = Hugoniot::of(concrete_sand::sand(components::ElasticUpdate::state));
  const auto simulation = Simulation::make(sand_at_wall(), 2);

  advance_to(*simulation, 4e-4);
  const double early = front(particles_of(*simulation), -0.5 * speed);
  advance_to(*simulation, 9e-4);
  const auto particles = particles_of(*simulation);
  const double late = front(particles, -0.5 * speed);

  double stress = 0, compression = 0, velocity = 0;
  int n = 0;
  for (const Particle& particle : particles) {
    if (particle.position[0] < 0.1 * late || particle.position[0] > 0.9 * late) continue;
    stress -= particle.stress[0];
    compression += particle.density / density;
    velocity += particle.velocity[0];
    ++n;
  }
  const double shock_speed = (late - early) / 5e-4 + speed;
  CHECK(stress / n == Approx(expected.stress).epsilon(0.01));
  CHECK(compression / n == Approx(expected.compression).epsilon(0.005));
  CHECK(shock_speed == Approx(expected.shock_speed).epsilon(0.01));
  CHECK(std::abs(velocity / n) < 0.002 * speed);
  // The jump of momentum from what was measured alone.
  CHECK(stress / n == Approx(density * shock_speed * speed).epsilon(0.01));
}

}  // namespace test_sand_shock
