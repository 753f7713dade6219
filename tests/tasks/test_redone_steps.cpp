#include <catch2/catch.hpp>

#include <cmath>
#include <string>

#include "tasks/simulation_error.hpp"
#include "tests/components/materials/concrete_sand.hpp"
#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_redone_steps
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// Two halves of a block of sand that part by the speed of their waves, over two materials and 4 x 4 patches: the
/// published bound allows steps in which particles are strained by more than a step takes, and on their ways from patch
/// to patch. A rigid ball falls beside them, and a pressure works on the smaller material.
Scene torn_sand()
{
  Scene scene = empty_scene(2, {24, 24, 1}, 0.05);
  scene.n_patches = {4, 4, 1};
  const components::TabularCap sand = concrete_sand::sand(components::ElasticUpdate::state);
  const auto [bulk, shear] = sand.initial_moduli();
  const double c = std::sqrt((bulk + 4 * shear / 3) / 1600);
  scene.materials.push_back({"sand", 1600, sand});
  const int rubber = add_elastic(scene, 1000, 1e6, 0.3), steel = add_elastic(scene, 7800, 2e11, 0.3);
  scene.time.rule = StepRule::published;
  scene.time.multiplier = 1;
  scene.gravity = {0, -9.81, 0};
  add_box(scene, 0, {0.3, 0.4, 0}, {0.9, 0.6, 0}).functions.velocity = [c](const Vector<3>& x) {
    return Vector<3>(x[0] < 0.6 ? -0.5 * c : 0.5 * c, 0, 0);
  };
  add_box(scene, rubber, {0.3, 0.75, 0}, {0.45, 0.9, 0}).pressure = BodyPressure{components::PressureCurve({{0, 1e3}})};
  add_disk(scene, steel, 0.8, 0.8, 0.1, {0, -1, 0});
  scene.bodies.back().rigid = true;
  return scene;
}

std::unique_ptr<Simulation> on_all_ranks(const Scene& scene, int n_threads)
{
  return Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()),
                          runtime::Communicator::world());
}

}  // namespace

TEST_CASE("a step that goes wrong is taken in shorter ones")
{
  const auto simulation = Simulation::make(torn_sand(), 2);
  const double allowed = simulation->stable_step();

  simulation->advance(1e30);

  const Occurrences& refused = simulation->refused();
  CHECK(refused.count > 0);
  CHECK(refused.first_step == 0);
  CHECK(refused.first_time == 0);
  CHECK(refused.first.material == 0);
  CHECK(refused.first.particle >= 0);
  // Where the sand is torn.
  CHECK(refused.first.position[0] == Approx(0.6).margin(0.1));
  CHECK(simulation->n_steps() == 1);
  CHECK(simulation->last_step_size() == allowed * std::pow(0.5, static_cast<double>(refused.count)));
  CHECK(simulation->step_records().count(StepCause::redone) == 1);
  CHECK(simulation->updates().failures == 0);
}

TEST_CASE("a step that was tried in vain leaves what the shorter step alone does")
{
  Scene scene = torn_sand();
  const auto redone = Simulation::make(scene, 2);
  redone->advance(1e30);
  scene.time.maximum_step = redone->last_step_size();
  const auto straight = Simulation::make(scene, 2);

  straight->advance(1e30);

  REQUIRE(redone->refused().count > 0);
  CHECK(straight->refused().count == 0);
  CHECK(redone->digest() == straight->digest());
  CHECK(redone->time() == straight->time());
  CHECK(redone->stable_step() == straight->stable_step());
  const EnergyLedger &a = redone->energies(), &b = straight->energies();
  CHECK(std::array{a.gained, a.elastic, a.plastic, a.contact, a.filter, a.driving, a.gravity} ==
        std::array{b.gained, b.elastic, b.plastic, b.contact, b.filter, b.driving, b.gravity});
  CHECK(redone->grid_totals().impulse == straight->grid_totals().impulse);
  CHECK(redone->updates().substeps == straight->updates().substeps);
  const MeanForces redone_forces = redone->take_mean_forces(), straight_forces = straight->take_mean_forces();
  CHECK(redone_forces.loads[1] == straight_forces.loads[1]);
  CHECK(redone_forces.loads[1].norm() > 0);
  CHECK(redone_forces.contact[2].force == straight_forces.contact[2].force);
}

TEST_CASE("steps are refused and redone with the same bits on any ranks and threads", "[ranks]")
{
  const Scene scene = torn_sand();
  const int n_steps = 40, n_threads = GENERATE(1, 3);
  const auto alone = Simulation::make(scene, 1);
  for (int n = 0; n < n_steps; ++n) alone->advance(1e30);
  REQUIRE(alone->refused().count > 1);

  const auto simulation = on_all_ranks(scene, n_threads);
  simulation->engine().balance_every(1);
  for (int n = 0; n < n_steps; ++n) simulation->advance(1e30);

  CHECK(simulation->digest() == alone->digest());
  CHECK(simulation->time() == alone->time());
  CHECK(simulation->refused().count == alone->refused().count);
  CHECK(simulation->refused().first.particle == alone->refused().first.particle);
  CHECK(simulation->step_records().by_cause == alone->step_records().by_cause);
  CHECK(simulation->step_records().last.setter.particle == alone->step_records().last.setter.particle);
  CHECK(simulation->energies().plastic == alone->energies().plastic);
}

TEST_CASE("a step that stays wrong ends the run once it has been tried as often as the scene allows", "[ranks]")
{
  Scene scene = torn_sand();
  scene.time.redos = 1;
  scene.time.redo_factor = 0.99;
  const auto simulation = on_all_ranks(scene, 2);
  const std::string digest = simulation->digest();

  CHECK_THROWS_AS(simulation->advance(1e30), SimulationError);

  CHECK(simulation->refused().count == 2);
  CHECK(simulation->n_steps() == 0);
  CHECK(simulation->digest() == digest);
}

TEST_CASE("matter that grows too stiff within a step has it redone")
{
  Scene scene = torn_sand();
  // Run together, not apart.
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(x[0] < 0.6 ? 150 : -150, 0, 0); };
  scene.time.multiplier = 0.5;
  scene.limits.courant_number = 0.6;
  const auto simulation = Simulation::make(scene, 1);

  while (simulation->refused().count == 0 && simulation->n_steps() < 200) simulation->advance(1e30);

  CHECK(simulation->refused().count > 0);
  CHECK(simulation->updates().failures == 0);
}

}  // namespace test_redone_steps
