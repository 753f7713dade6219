#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"
#include "tools/advice/penetration.hpp"
#include "tools/advice/wave_box.hpp"
#include "tools/scene/read_scene.hpp"

/// The box that `tamp check` advises, beside the whole one.
namespace test_wave_box
{

using namespace tamp;
using namespace tamp::test;

namespace
{

Scene scene_of(const std::string& file, const std::vector<std::string>& changes)
{
  return tools::read_scene(std::filesystem::path(TAMP_SOURCE_DIR) / "inputs" / file, changes).scene;
}

/// The first body's way by the end of the scene [m].
double way_in(const Scene& scene)
{
  const auto simulation = Simulation::make(scene, 1);
  advance_to(*simulation, scene.time.end);
  const BodySums body = simulation->report().bodies[0];
  return (body.reference_position - body.position).norm() / body.mass;
}

/// The changes with those that the advice on the box adds.
std::vector<std::string> with_advised_box(const std::string& file, std::vector<std::string> changes)
{
  const Scene scene = scene_of(file, changes);
  const auto penetration = tools::penetration_of(scene, scene.bodies[0]);
  REQUIRE(penetration);
  const std::string advice = tools::advice_on_box(scene, scene.bodies[0], *penetration->into);
  const std::size_t settings = advice.find("are enough, with ");
  REQUIRE(settings != std::string::npos);
  std::istringstream words(advice.substr(advice.find('/', settings)));
  for (std::string word; words >> word;) changes.push_back(word);
  return changes;
}

double n_cells(const Scene& scene)
{
  return double(scene.grid.n_cells[0]) * scene.grid.n_cells[1] * scene.grid.n_cells[2];
}

}  // namespace

TEST_CASE("in the box that waves do not come back from a body goes as deep as in the whole, to 1e-4", "[slow]")
{
  const auto [file, end] = GENERATE(table<std::string, double>(
      {{"punch/quick.json", 1e-4}, {"punch/quick.json", 3e-4}, {"savings/ball.json", 5e-5}, {"uxo/half.json", 5e-5}}));
  const std::vector<std::string> changes{fmt::format("/time/end={}", end_of(end))};
  CAPTURE(file, changes);
  const Scene whole = scene_of(file, changes), part = scene_of(file, with_advised_box(file, changes));

  CHECK(n_cells(part) <= 0.8 * n_cells(whole));
  CHECK(way_in(part) == Approx(way_in(whole)).epsilon(1e-4));
}

}  // namespace test_wave_box
