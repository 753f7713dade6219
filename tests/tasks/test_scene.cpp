#include <catch2/catch.hpp>

#include "runtime/graph/graph_error.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_scene
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A block on four patches in a row.
Scene block_on_patches(int patch_width)
{
  Scene scene = empty_scene(2, {4 * patch_width, 4, 1}, 0.1);
  scene.n_patches = {4, 1, 1};
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.3), {0.1, 0.1, 0}, {0.3, 0.3, 1});
  return scene;
}

}  // namespace

TEST_CASE("a step needs patches of the least width, and no more")
{
  const int least_width = least_patch_width(GENERATE(Interpolator("gimp"), Interpolator("quadratic_spline")));
  CHECK_NOTHROW(Simulation::make(block_on_patches(least_width), 1));
  CHECK_THROWS_AS(Simulation::make(block_on_patches(least_width - 1), 1), runtime::GraphError);
}

TEST_CASE("a deformable body starts with its angular velocity, about its centre of mass")
{
  const Eigen::Vector3d velocity(1, 2, 3), spin(4, -5, 6);
  Scene scene = empty_scene(3, {12, 12, 12}, 0.1);
  SceneBody& body = add_box(scene, add_elastic(scene, 1000, 1e6, 0.3), {0.2, 0.3, 0.4}, {0.6, 0.8, 0.7}, {1, 2, 3});
  body.angular_velocity = {4, -5, 6};

  const BodySums sums = Simulation::make(scene, 1)->report().bodies[0];

  CHECK((sums.spin() - spin).norm() < 1e-12 * spin.norm());
  CHECK((sums.momentum / sums.mass - velocity).norm() < 1e-12 * velocity.norm());
}

}  // namespace test_scene
