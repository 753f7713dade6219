#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"
#include "tests/tools/rehearsal.hpp"
#include "tools/scene/read_scene.hpp"

/// Axisymmetric scenes beside the same in space, on the same cells.
namespace test_round_scenes
{

using namespace tamp;
using namespace tamp::test;

namespace
{

Scene scene_of(const std::string& file, const std::vector<std::string>& changes)
{
  return tools::read_scene(std::filesystem::path(TAMP_SOURCE_DIR) / "inputs/savings" / file, changes).scene;
}

/// The body's way along an axis until the end of the scene.
double way_of_ball(const Scene& scene, int axis)
{
  const auto simulation = Simulation::make(scene, 1);
  advance_to(*simulation, end_of(scene.time.end));
  const BodySums ball = simulation->report().bodies[0];
  return (ball.reference_position[axis] - ball.position[axis]) / ball.mass;
}

}  // namespace

TEST_CASE("a free ball goes as deep into sand in the plane of r and z as a quarter of it does in space", "[slow]")
{
  const double turned = way_of_ball(scene_of("ball.json", {"/grid/cell_size=0.004", "/grid/upper=[0.048,0.084]"}), 1);
  const double quarter =
      way_of_ball(scene_of("ball_in_space.json", {"/grid/cell_size=0.004", "/grid/upper=[0.048,0.048,0.084]"}), 2);

  CAPTURE(turned, quarter);
  if (!is_rehearsal) CHECK(turned == Approx(quarter).epsilon(0.025));
}

TEST_CASE("a free rigid body of an axisymmetric scene stays on the axis and does not turn")
{
  const Scene scene = scene_of("projectile_straight_down.json", {"/time/end=5e-5"});
  const auto simulation = Simulation::make(scene, 1);

  advance_to(*simulation, end_of(scene.time.end));

  const BodySums projectile = simulation->report().bodies[0];
  CHECK(projectile.position.x() == 0);
  CHECK(projectile.momentum.x() == 0);
  CHECK(projectile.angular_momentum.isZero(0));
  CHECK(projectile.momentum.y() > -283 * projectile.mass);
}

TEST_CASE("an axisymmetric projectile has the same digest on any ranks and threads", "[ranks]")
{
  const Scene scene = scene_of("projectile_straight_down.json", {});
  const auto digest = [&](int n_threads, const runtime::Communicator& communicator) {
    const auto simulation =
        Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()), communicator);
    for (int n = 0; n < n_steps_of(60); ++n) simulation->advance(1);
    return simulation->digest();
  };
  const std::string alone = digest(1, {});

  for (const int n_threads : {1, 2}) CHECK(digest(n_threads, runtime::Communicator::world()) == alone);
}

}  // namespace test_round_scenes
