#include <catch2/catch.hpp>

#include "tasks/forecast/demand.hpp"
#include "tasks/forecast/pace.hpp"
#include "tasks/simulation.hpp"
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

TEST_CASE("the memory of fields that is forecast from labels is what a simulation then stores")
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

TEST_CASE("the steps of the quick punch are forecast within a factor of two, from trials of less than a second")
{
  const std::optional<tasks::Pace> pace = tasks::pace_of(shipped("punch/quick.json"), {});

  constexpr double taken = 5200;
  REQUIRE(pace);
  CHECK(pace->n_steps > taken / 2);
  CHECK(pace->n_steps < taken * 2);
  CHECK(pace->core_seconds > 0);
}

}  // namespace test_demand
