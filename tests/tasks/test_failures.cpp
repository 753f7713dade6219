#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tasks/simulation_error.hpp"
#include "tests/components/materials/concrete_sand.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_failures
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A block of rubber, 8 x 8 particles, in the middle of a grid of two patches. No step is tried again.
Scene block()
{
  Scene scene = empty_scene(2, {12, 12, 1}, 0.1);
  scene.time.redos = 0;
  scene.n_patches = {2, 1, 1};
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.3), {0.4, 0.4, 0}, {0.8, 0.8, 0});
  return scene;
}

/// Advances until it cannot, and says why; the state must then be the one before.
SimulationError failure_of(Simulation& simulation, int most_steps)
{
  for (int i = 0; i < most_steps; ++i) {
    const std::string digest = simulation.digest();
    const long n_steps = simulation.n_steps();
    const std::size_t n_particles = simulation.n_particles(0);
    const double time = simulation.time(), elastic = simulation.energies().elastic;
    try {
      simulation.advance(1e30);
    } catch (const SimulationError& error) {
      CHECK(simulation.digest() == digest);
      CHECK(simulation.n_steps() == n_steps);
      CHECK(simulation.time() == time);
      CHECK(simulation.energies().elastic == elastic);
      CHECK(simulation.n_particles(0) == n_particles);
      return error;
    }
  }
  throw std::logic_error("no error in " + std::to_string(most_steps) + " steps");
}

}  // namespace

TEST_CASE("a particle that inverts ends the run at the last good state")
{
  const int n_threads = GENERATE(1, 2);
  Scene scene = block();
  // Steps far beyond what is stable, as the published rule allows them.
  scene.time.rule = StepRule::published;
  scene.time.multiplier = 3;
  scene.limits.courant_number = 100;
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(x[0] < 0.6 ? 1.0 : -1.0, 0, 0); };
  const auto simulation = Simulation::make(scene, n_threads);

  const SimulationError error = failure_of(*simulation, 100);

  CHECK(simulation->n_steps() > 0);
  CHECK(std::string(error.what()).find("inside out") != std::string::npos);
  CHECK(error.material == "elastic 0");
  CHECK(error.particle >= 0);
  CHECK(error.particle < 64);
  REQUIRE(error.position.size() == 2);
  CHECK((error.position[0] > 0 && error.position[0] < 1.2));
}

TEST_CASE("a velocity that is not a number ends the run before it spreads")
{
  const int n_threads = GENERATE(1, 2);
  Scene scene = block();
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) {
    return Vector<3>(x[0] < 0.43 && x[1] < 0.43 ? std::nan("") : 0.0, 0, 0);
  };
  const auto simulation = Simulation::make(scene, n_threads);

  const SimulationError error = failure_of(*simulation, 1);

  CHECK(error.particle >= 0);
  REQUIRE(error.position.size() == 2);
  // Within the reach of the particle at (0.425, 0.425).
  CHECK(error.position[0] < 0.7);
  CHECK(error.position[1] < 0.7);
}

TEST_CASE("a step below the scene's least one ends the run")
{
  Scene scene = block();
  const double bound = Simulation::make(scene, 1)->stable_step();
  scene.time.minimum_step = scene.time.multiplier * bound * 1.001;
  const auto simulation = Simulation::make(scene, 1);

  const SimulationError error = failure_of(*simulation, 1);

  CHECK(error.particle == -1);
  CHECK(std::string(error.what()).find("below the minimum") != std::string::npos);
}

TEST_CASE("the last step of a run may be as short as it must to end in time")
{
  Scene scene = block();
  const double step = scene.time.multiplier * Simulation::make(scene, 1)->stable_step();
  scene.time.minimum_step = 0.9 * step;
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, 1.25 * step);

  CHECK(simulation->time() == 1.25 * step);
  CHECK(simulation->last_step_size() == Approx(0.25 * step));
  CHECK(simulation->n_steps() == 2);
}

TEST_CASE("a run goes on from the last good state after an error")
{
  Scene scene = block();
  scene.time.rule = StepRule::published;
  scene.time.multiplier = 3;
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(x[0] < 0.6 ? 1.0 : -1.0, 0, 0); };
  // On one thread, as of two patches that fail either may be the first.
  const auto simulation = Simulation::make(scene, 1);
  const std::string first = failure_of(*simulation, 100).what();

  CHECK(std::string(failure_of(*simulation, 1).what()) == first);
  // A step that is short enough succeeds.
  simulation->advance(simulation->time() * (1 + 1e-9));
}

namespace
{

/// A block of sand that is torn apart faster than a step can take. None is tried again.
Scene torn_sand()
{
  Scene scene = empty_scene(2, {12, 12, 1}, 0.1);
  scene.time.redos = 0;
  scene.n_patches = {2, 1, 1};
  const components::TabularCap sand = concrete_sand::sand(components::ElasticUpdate::state);
  const auto [bulk, shear] = sand.initial_moduli();
  const double c = std::sqrt((bulk + 4 * shear / 3) / 1600);
  scene.materials.push_back({"sand", 1600, sand});
  scene.time.rule = StepRule::published;
  scene.time.multiplier = 1;
  add_box(scene, 0, {0.3, 0.4, 0}, {0.9, 0.8, 0}).functions.velocity = [c](const Vector<3>& x) {
    return Vector<3>(x[0] < 0.6 ? -0.5 * c : 0.5 * c, 0, 0);
  };
  return scene;
}

}  // namespace

TEST_CASE("a stress update that fails ends the run with its particle's history, the same for any threads")
{
  std::vector<std::string> reasons;
  for (int n_threads : {1, 2}) {
    const auto simulation = Simulation::make(torn_sand(), n_threads);
    reasons.emplace_back(failure_of(*simulation, 10).what());
  }

  CHECK(reasons[0] == reasons[1]);
  CHECK(reasons[0].find("strain increment in one step is larger") != std::string::npos);
  CHECK(reasons[0].find("failed_updates 1") != std::string::npos);
  CHECK(reasons[0].find("0 are allowed") != std::string::npos);
}

TEST_CASE("a step that is refused leaves the state before it whole, though particles would have left their patches")
{
  Scene scene = torn_sand();
  scene.n_patches = {4, 4, 1};
  const auto simulation = Simulation::make(scene, 2);
  const std::string digest = simulation->digest();

  failure_of(*simulation, 1);

  CHECK(simulation->n_steps() == 0);
  CHECK(simulation->digest() == digest);
}

TEST_CASE("updates that may fail are counted, and their particles marked")
{
  Scene scene = torn_sand();
  scene.failed_updates_allowed = 1L << 32;  // more than 32 bits hold
  const auto simulation = Simulation::make(scene, 2);

  simulation->advance(1e30);

  const std::size_t failures = simulation->updates().failures;
  CHECK(failures > 0);
  const auto blocks = simulation->particle_columns();
  const auto& columns = blocks[0].columns;
  const auto marks =
      std::find_if(columns.begin(), columns.end(), [](const auto& c) { return c.name == "failed_updates"; });
  REQUIRE(marks != columns.end());
  double marked = 0;
  for (const double n : std::get<std::span<const double>>(marks->values)) marked += n;
  CHECK(marked == static_cast<double>(failures));
}

}  // namespace test_failures
