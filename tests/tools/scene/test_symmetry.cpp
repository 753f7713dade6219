#include "tools/scene/bodies/symmetry.hpp"

#include <catch2/catch.hpp>

#include "tests/tools/scene/small_scene.hpp"
#include "tools/advice/round_scene.hpp"

namespace test_symmetry_of_scenes
{

using namespace tamp;
using namespace tamp::test;

namespace
{

tasks::Scene scene_with(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  return tools::read_scene(folder.write("scene.json", small_scene), assignments).scene;
}

tasks::Scene shipped(const std::string& file, const std::vector<std::string>& assignments = {})
{
  return tools::read_scene(TAMP_SOURCE_DIR "/inputs/" + file, assignments).scene;
}

/// The small scene's block in the middle of its grid, of 4 cells along each axis.
std::vector<std::string> centred(const std::string& change)
{
  return {"/grid/cell_size=0.5", "/bodies/block/geometry/lower=[0.5,0.5]", "/bodies/block/geometry/upper=[1.5,1.5]",
          change};
}

std::string pressed_from_to(const std::string& lower, const std::string& upper)
{
  return "/bodies/block/pressure={\"value\":1,\"within\":{\"lower\":" + lower + ",\"upper\":" + upper + "}}";
}

using Axes = std::vector<std::size_t>;

}  // namespace

TEST_CASE("a scene is symmetric about the middle of its grid where all in it is")
{
  CHECK(tools::symmetric_axes(scene_with(centred("/title=block"))) == Axes{0, 1});
  CHECK(tools::symmetric_axes(scene_with(centred("/bodies/block/velocity=[0,-1]"))) == Axes{0});
  CHECK(tools::symmetric_axes(scene_with(centred("/bodies/block/angular_velocity=[1]"))).empty());
  CHECK(tools::symmetric_axes(scene_with(centred("/gravity=[0,-10]"))) == Axes{0});
  CHECK(tools::symmetric_axes(scene_with(centred("/boundaries/y+=open"))) == Axes{0});
  CHECK(tools::symmetric_axes(scene_with(centred("/boundaries/x-={\"friction\":0.1}"))) == Axes{1});
  CHECK(tools::symmetric_axes(scene_with(centred("/bodies/block/pressure={\"value\":1}"))) == Axes{0, 1});
  CHECK(tools::symmetric_axes(scene_with(centred(pressed_from_to("[0.8,0]", "[1.2,2]")))) == Axes{0, 1});
  CHECK(tools::symmetric_axes(scene_with(centred(pressed_from_to("[0.8,1.4]", "[1.2,2]")))) == Axes{0});
  CHECK(tools::symmetric_axes(scene_with(centred(pressed_from_to("[0.8,0]", "[2,2]")))) == Axes{1});
  // By less than half a particle too far to one side, which then has one more.
  CHECK(tools::symmetric_axes(scene_with(centred("/bodies/block/geometry={\"type\":\"box\",\"lower\":[0.45,0.5],"
                                                 "\"upper\":[1.65,1.5]}"))) == Axes{1});
  CHECK(tools::symmetric_axes(scene_with({})).empty());
  CHECK(tools::symmetric_axes(shipped("uxo/quick.json")).empty());
  CHECK(tools::symmetric_axes(shipped("uxo/quick.json", {"/centrifuge=null"})) == Axes{1});
}

TEST_CASE("a scene in space is round where all in it is round about one line, or fills the grid across it")
{
  const auto cone = tools::round_scene(shipped("cone/quick.json"));
  REQUIRE(cone);
  CHECK(cone->axis == 2);
  CHECK(cone->through == Eigen::Vector3d(0, 0, 0));
  CHECK(cone->n_particles == shipped("cone/axisymmetric.json", {"/grid/cell_size=0.005"}).n_particles());
  CHECK(tools::round_scene(shipped("savings/ball_in_space.json")));
  CHECK_FALSE(tools::round_scene(shipped("cone/quick.json", {"/gravity=[1,0,-9.81]"})));
  CHECK_FALSE(tools::round_scene(shipped("uxo/quick.json", {"/centrifuge=null"})));
  CHECK_FALSE(tools::round_scene(shipped("punch/slab.json")));
  // A square block.
  CHECK_FALSE(tools::round_scene(shipped("peers/block_3d.json")));
  CHECK_FALSE(tools::round_scene(shipped("cone/axisymmetric.json")));
}

TEST_CASE("the advice to halve a scene is a scene that is not symmetric any more")
{
  const auto advice = tools::advice_to_halve(shipped("punch/quick.json"));

  REQUIRE(advice);
  CHECK(advice->find("symmetric about x = 0.5: half of the scene") == 0);
  CHECK(advice->find("/grid/lower=[0.5,0] /grid/patches=[1,2]") != std::string::npos);
  CHECK_FALSE(tools::advice_to_halve(shipped("punch/quick.json", {"/grid/lower=[0.5,0]", "/grid/patches=[1,2]"})));
}

TEST_CASE("planes of symmetry are those that cut a body or along which one moves, and no walls of a box")
{
  const tasks::Sides none{}, x{{{true, false}, {}, {}}}, y{{{}, {true, false}, {}}},
      xy{{{true, false}, {true, false}, {}}};

  CHECK(tools::planes_of_symmetry(shipped("punch/quick.json")) == none);
  CHECK(tools::planes_of_symmetry(shipped("punch/half.json")) == x);
  CHECK(tools::planes_of_symmetry(shipped("uxo/half.json")) == y);
  CHECK(tools::planes_of_symmetry(shipped("cone/quick.json")) == xy);
  CHECK(tools::planes_of_symmetry(scene_with({"/bodies/block/velocity=[0,-1]"})) == x);
  CHECK(tools::planes_of_symmetry(
            scene_with({"/bodies/block/geometry/upper=[2,1]", "/bodies/block/velocity=[0,-1]"})) == none);
}

}  // namespace test_symmetry_of_scenes
