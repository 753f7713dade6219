#include <catch2/catch.hpp>

#include <utility>

#include "tests/tasks/scenes.hpp"

namespace test_elastic_impact
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A bar of uniaxial strain along x.
struct Bar {
  double density;
  /// Young's modulus
  double E;
  double poisson = 0.25;

  double wave_speed() const { return std::sqrt(uniaxial_modulus(E, poisson) / density); }
  double impedance() const { return density * wave_speed(); }
};

/// `left` runs at `speed` into `right`, which rests; they touch at x = 1 m and are 1 m long each.
Scene collision(const Bar& left, const Bar& right, double speed, int n_cells)
{
  Scene scene = empty_scene(2, {2 * n_cells + 16, 2, 1}, 1.0 / n_cells);
  const double margin = 8.0 / n_cells;
  scene.grid.lower[0] = -margin;
  add_walls(scene, 1);
  scene.artificial_viscosity = components::ArtificialViscosity{};
  scene.time.multiplier = 0.5;
  add_box(scene, add_elastic(scene, left.density, left.E, left.poisson), {0, 0, 0}, {1, 1e9, 0}, {speed, 0, 0});
  add_box(scene, add_elastic(scene, right.density, right.E, right.poisson), {1, 0, 0}, {2, 1e9, 0});
  return scene;
}

/// Mean of a component of stress over the particles of a material between two places [m].
double mean_stress(const std::vector<Particle>& particles, int material, double from, double to)
{
  double sum = 0;
  int n = 0;
  for (const Particle& particle : particles) {
    if (particle.material != material || particle.position[0] < from || particle.position[0] > to) continue;
    sum += particle.stress[0];
    ++n;
  }
  REQUIRE(n > 0);
  return sum / n;
}

}  // namespace

TEST_CASE("bars that collide press on each other as their impedances say, and the front runs at the wave speed")
{
  const Bar heavy{7800, 2e9}, light{2700, 0.7e9};
  const auto [left, right] = GENERATE_COPY(std::pair{heavy, heavy}, std::pair{heavy, light}, std::pair{light, heavy});
  constexpr int n_cells = 100;
  constexpr double h = 1.0 / n_cells;
  const double speed = 1e-3 * left.wave_speed();
  const auto simulation = Simulation::make(collision(left, right, speed, n_cells), 1);
  // The fronts are on their way to the far ends.
  const double time = 0.7 / std::max(left.wave_speed(), right.wave_speed());

  advance_to(*simulation, time);

  const double both = left.impedance() + right.impedance();
  const double stress = -left.impedance() * right.impedance() / both * speed;
  const double velocity = left.impedance() / both * speed;
  const auto particles = particles_of(*simulation);
  const double way_left = left.wave_speed() * time, way_right = right.wave_speed() * time;
  CHECK(mean_stress(particles, 0, 1 - 0.7 * way_left, 0.95) == Approx(stress).epsilon(0.005));
  CHECK(mean_stress(particles, 1, 1.05, 1 + 0.7 * way_right) == Approx(stress).epsilon(0.005));
  CHECK(mean_stress(particles, 1, 1, 1 + 2 * h) == Approx(stress).epsilon(0.005));
  // Viscosity holds the middle of the front back by less than a cell.
  CHECK(front(particles_of_material(particles, 1), velocity / 2) == Approx(1 + way_right).margin(h));
  const double energy = left.density * h * speed * speed;
  CHECK(simulation->report().kinetic + worked(simulation->energies()) == Approx(energy).epsilon(0.005));
}

}  // namespace test_elastic_impact
