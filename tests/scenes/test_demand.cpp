#include <catch2/catch.hpp>

#include "tasks/forecast/demand.hpp"
#include "tasks/forecast/pace.hpp"
#include "tasks/simulation.hpp"
#include "tests/tools/rehearsal.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_demand
{

using namespace tamp;

namespace
{

tasks::Scene shipped(const std::string& name)
{
  return tools::read_scene(std::string(TAMP_SOURCE_DIR "/inputs/") + name).scene;
}

}  // namespace

TEST_CASE("the memory of fields that is forecast from labels is what a simulation then stores", "[slow]")
{
  const std::string name = GENERATE("punch/quick.json", "punch/table.json", "uxo/quick.json", "uxo/settled.json");
  const tasks::Scene scene = shipped(name);

  const tasks::Demand demand = tasks::demand_of(scene);

  const auto simulation = tasks::Simulation::make(scene, 1);
  std::size_t n_particles = 0;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) n_particles += simulation->n_particles(static_cast<int>(m));
  INFO(name);
  CHECK(demand.n_particles == n_particles);
  CHECK(demand.fields == Approx(static_cast<double>(simulation->forecast_bytes())).epsilon(0.03));
  double copied = 0;
  for (const auto& bytes : simulation->engine().copy_checkpoint("", {}).bytes)
    copied += static_cast<double>(bytes.size());
  CHECK(demand.checkpoint_file == Approx(copied).epsilon(0.03));
}

TEST_CASE(
    "the steps of shipped scenes are forecast within a factor of 1.5, in the time that a run and the check take for it",
    "[slow][pinned]")
{
  // Pinned: the steps that whole runs of these scenes took. The factor is what a forecast is needed for.
  const auto [name, taken] = GENERATE(table<std::string, double>({{"punch/quick.json", 5197},
                                                                  {"punch/half.json", 6024},
                                                                  {"cone/axisymmetric.json", 8160},
                                                                  {"footing/quick.json", 1334},
                                                                  {"peers/block.json", 10000},
                                                                  {"savings/ball.json", 974},
                                                                  {"savings/projectile_straight_down.json", 700},
                                                                  {"savings/rod.json", 390},
                                                                  {"stability/scenes/approach.json", 185},
                                                                  {"verification/scenes/column_collapse.json", 23518},
                                                                  {"verification/scenes/rotating_frame.json", 40},
                                                                  {"verification/vortex/quick.json", 188}}));
  const tasks::Scene scene = shipped(name);

  const std::optional<tasks::Pace> of_run = tasks::pace_of(scene, {.part_of_run = test::end_of(0.02)}),
                                   of_check = tasks::pace_of(scene, {});

  REQUIRE(of_run);
  REQUIRE(of_check);
  CAPTURE(name, taken, of_run->n_steps, of_check->n_steps);
  if (test::is_rehearsal) return;
  constexpr double factor = 1.5;
  for (const double forecast : {of_run->n_steps, of_check->n_steps}) {
    CHECK(forecast > taken / factor);
    CHECK(forecast < taken * factor);
  }
  CHECK(of_check->core_seconds > 0);
}

TEST_CASE("a scene whose longest step is given takes as many steps as that allows, on whatever cells it is tried")
{
  tasks::Scene scene = shipped("stability/scenes/approach.json");
  scene.time.maximum_step = scene.time.end / 1000;

  const std::optional<tasks::Pace> pace = tasks::pace_of(scene, {.seconds = 0.01});

  REQUIRE(pace);
  CHECK(pace->n_steps == Approx(1000).epsilon(0.01));
}

}  // namespace test_demand
