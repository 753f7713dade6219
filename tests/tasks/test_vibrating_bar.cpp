#include <catch2/catch.hpp>

#include <numbers>
#include <utility>

#include "components/problems/vibrating_bar.hpp"
#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_vibrating_bar
{

using namespace tamp;
using namespace tamp::test;

namespace
{

constexpr double pi = std::numbers::pi;
constexpr double length = 25;
constexpr double density = 1;
constexpr double poisson = 0.25;
/// Modulus of uniaxial strain; the bar's waves run at 10 m/s.
constexpr double modulus = 100;
constexpr double wave_speed = 10;

/// A bar along x in uniaxial strain, between smooth walls 2 cells apart; its lower end is held at x = 0. `held` says
/// whether its upper end is too; otherwise there is a cell of free space beyond it.
Scene bar(int n_cells, bool held)
{
  Scene scene = empty_scene(2, {n_cells + (held ? 0 : 4), 2, 1}, length / n_cells);
  scene.faces[0] = {components::SymmetryFace(), held ? Face(components::SymmetryFace()) : Face(components::OpenFace())};
  add_walls(scene, 1);
  add_box(scene, add_elastic(scene, density, modulus / uniaxial_modulus(1, poisson), poisson), {0, 0, 0},
          {length, 1e9, 0});
  return scene;
}

/// The bar starts with v = speed sin(k x).
void start_in_mode(Scene& scene, double speed, double k)
{
  const components::VibratingBar problem{speed, k};
  scene.bodies[0].functions = problem.functions({2, density, scene.materials[0].model});
}

/// Amplitude of sin(k x) in the velocities, x where each particle started.
double mode(const std::vector<Particle>& start, const std::vector<Particle>& now, double k)
{
  double sum = 0, norm = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const double shape = std::sin(k * start[p].position[0]);
    sum += shape * now[p].velocity[0];
    norm += shape * shape;
  }
  return sum / norm;
}

struct Vibration {
  double frequency_error;
  /// Mean energy of the last period against that of the first, relative.
  double energy_drift;
};

/// Lets a bar swing in the mode sin(k x) from a small velocity, and looks at its first two and last two periods.
Vibration swing(Scene scene, double k, int n_periods)
{
  start_in_mode(scene, 1e-3, k);
  const auto simulation = Simulation::make(scene, 1);
  const auto start = particles_of(*simulation);
  const double period = 2 * pi / (k * wave_speed), end = end_of(n_periods * period);

  double first_crossing = 0, last_crossing = 0, amplitude_before = 0, time_before = 0;
  double energy_first = 0, energy_last = 0;
  int n_first = 0, n_last = 0;
  while (simulation->time() < end) {
    const double elastic_before = simulation->energies().elastic;
    simulation->advance(end);
    // Velocities are of the middle of the step.
    const double time = simulation->time() - 0.5 * simulation->last_step_size();
    if (time > 2 * period && time < end - 2 * period) continue;
    const double amplitude = mode(start, particles_of(*simulation), k);
    if (amplitude_before * amplitude < 0 && time - time_before < 0.1 * period) {
      const double part = amplitude_before / (amplitude_before - amplitude);
      last_crossing = time_before + part * (time - time_before);
      if (first_crossing == 0) first_crossing = last_crossing;
    }
    amplitude_before = amplitude;
    time_before = time;
    const double energy = simulation->report().kinetic + 0.5 * (elastic_before + simulation->energies().elastic);
    if (time < period) energy_first += energy, ++n_first;
    if (time > end - period) energy_last += energy, ++n_last;
  }
  const double n_half_periods = std::round((last_crossing - first_crossing) / (0.5 * period));
  const double frequency = n_half_periods * pi / (last_crossing - first_crossing);
  return {frequency / (k * wave_speed) - 1, (energy_last / n_last) / (energy_first / n_first) - 1};
}

}  // namespace

TEST_CASE("a bar swings at the frequency of its length and waves, and goes on swinging", "[slow]")
{
  const auto [held, n_cells] = GENERATE(std::pair{false, 48}, std::pair{true, 80});
  const auto [hyperelastic, transfer] = GENERATE(
      std::pair{false, Transfer("flip")}, std::pair{false, Transfer("tflip")}, std::pair{true, Transfer("flip")});
  Scene scene = bar(n_cells, held);
  scene.transfer = transfer;
  scene.interpolator = GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline"));
  if (hyperelastic) {
    const auto solid = std::get<components::Hypoelastic>(scene.materials[0].model);
    scene.materials[0].model = components::NeoHookean{solid.bulk_modulus, solid.shear_modulus};
  }
  scene.time.multiplier = 0.5;

  const Vibration vibration = swing(scene, pi / ((held ? 1 : 2) * length), 20);

  if (is_rehearsal) return;
  CHECK(std::abs(vibration.frequency_error) < 1e-3);
  CHECK(std::abs(vibration.energy_drift) < 1e-3);
}

TEST_CASE("whenever stress follows the motion, a bar swings at its frequency in short steps", "[slow]")
{
  Scene scene = bar(48, false);
  scene.stress_timing = GENERATE(StressTiming::usf, StressTiming::musl);
  scene.time.multiplier = 0.4;

  const Vibration vibration = swing(scene, pi / (2 * length), 4);

  if (is_rehearsal) return;
  CHECK(std::abs(vibration.frequency_error) < 1e-3);
  CHECK(std::abs(vibration.energy_drift) < 1e-3);
}

namespace
{

/// Kinetic energy over that of the start, once a bar whose neighbour nodes move against each other has shaken for
/// `n_steps` steps of `courant` h / c.
double growth_of_highest_mode(double courant, int particles_per_axis, int n_steps)
{
  constexpr int n_cells = 16;
  Scene scene = bar(n_cells, true);
  scene.particles_per_axis = particles_per_axis;
  scene.time.rule = StepRule::published;
  scene.time.multiplier = 1;
  scene.time.maximum_step = courant * scene.grid.cell_size / wave_speed;
  const double k = pi * (n_cells - 1) / length;
  start_in_mode(scene, 1e-9, k);
  const auto simulation = Simulation::make(scene, 1);
  const double energy = simulation->report().kinetic;
  for (int i = 0; i < n_steps; ++i) simulation->advance(1e30);
  REQUIRE(simulation->time() == Approx(n_steps * scene.time.maximum_step));
  return simulation->report().kinetic / energy;
}

}  // namespace

TEST_CASE("the longest stable step is that of the particles' share in their nodes")
{
  // Nodes take the whole of an acceleration to the positions, and of the velocities that particles bring back of the
  // grid's highest mode only the part r, the square of what the particles see of it. With Omega = (omega dt)^2,
  // x'' = -omega^2 x becomes z^2 - (2 - Omega) z + 1 - (1 - r) Omega = 0: stable up to Omega = 4 / (2 - r), which is
  // dt = h / c / sqrt(2 - r).
  const auto [particles_per_axis, r] = GENERATE(std::pair{1, 0.0}, std::pair{2, 0.25}, std::pair{4, 0.3125});
  const double limit = 1 / std::sqrt(2 - r);

  CHECK(growth_of_highest_mode(0.97 * limit, particles_per_axis, 400) < 1);
  CHECK(growth_of_highest_mode(1.03 * limit, particles_per_axis, 400) > 1e3);
}

namespace
{

/// A bar starts to hang in its own weight: relative error of the first mode in its displacements at a time when it has
/// come 9/10 of its way down. Steps are equal. `head_start`, in steps: how long gravity has already pulled at the
/// start.
double error_of_hanging(int n_cells, double head_start, Transfer transfer)
{
  constexpr double g = 1e-4, k = pi / (2 * length), omega = k * wave_speed, end = 4;
  const int n_steps = 5 * n_cells;
  Scene scene = bar(n_cells, false);
  scene.transfer = transfer;
  scene.gravity = {g, 0, 0};
  scene.time.maximum_step = end / n_steps;
  scene.bodies[0].velocity[0] = head_start * g * end / n_steps;
  const auto simulation = Simulation::make(scene, 1);
  const auto start = particles_of(*simulation);

  advance_to(*simulation, end);

  REQUIRE(simulation->n_steps() <= n_steps + 1);
  const auto now = particles_of(*simulation);
  double amplitude = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    amplitude += 2 * std::sin(k * start[p].position[0]) * (now[p].position[0] - start[p].position[0]);
  }
  amplitude /= static_cast<double>(now.size());
  return amplitude / (4 / pi * g / (omega * omega) * (1 - std::cos(omega * end))) - 1;
}

}  // namespace

TEST_CASE("errors are of second order in cell and step, and of first where the first kick is not half a step",
          "[pinned]")
{
  const auto [transfer, bound] = GENERATE(std::pair{Transfer("flip"), 2.5e-3}, std::pair{Transfer("tflip"), 1.5e-3});
  const auto error = [t = transfer](int n_cells, double head_start) {
    return error_of_hanging(n_cells, head_start, t);
  };
  const double coarse = error(16, 0), middle = error(32, 0), fine = error(64, 0);
  // The bounds are pinned; the orders are held against theory.
  CHECK(std::abs(coarse) < bound);
  CHECK(std::log2(coarse / middle) == Approx(2).margin(0.1));
  CHECK(std::log2(middle / fine) == Approx(2).margin(0.1));

  // The error that a whole first kick adds.
  const double coarse_kick = error(16, 0.5) - coarse, fine_kick = error(64, 0.5) - fine;
  CHECK(coarse_kick > 2 * std::abs(coarse));
  CHECK(0.5 * std::log2(coarse_kick / fine_kick) == Approx(1).margin(0.05));
}

}  // namespace test_vibrating_bar
