#include <catch2/catch.hpp>

#include "tests/tools/temporary_folder.hpp"
#include "tools/advice/penetration.hpp"
#include "tools/advice/plausibility.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_penetration
{

using namespace tamp;
using namespace tamp::test;
using tools::CheckedScene;
using tools::Penetration;

namespace
{

/// A punch 0.6 m wide on its way into ground that reaches from wall to wall.
constexpr const char* scene = R"({
  "dimension": 2,
  "grid": { "upper": [2, 2], "cell_size": 0.1 },
  "time": { "end": 0.1 },
  "materials": {
    "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 10e9, "shear_modulus": 7e9 },
    "clay": { "type": "hypoelastic", "density": 2000, "bulk_modulus": 1e7, "shear_modulus": 5e6 }
  },
  "bodies": {
    "punch": {
      "material": "steel",
      "geometry": { "type": "box", "lower": [0.7, 1], "upper": [1.3, 1.5] },
      "velocity": [0, -10]
    },
    "ground": { "material": "clay", "geometry": { "type": "box", "lower": [0, 0], "upper": [2, 1] } }
  }
})";

CheckedScene checked_with(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  return tools::read_scene(folder.write("scene.json", scene), assignments);
}

/// The half width with which a body is on its way into another one [m]; 0 where it is not.
double half_width(const std::string& name, const std::vector<std::string>& assignments)
{
  const CheckedScene checked = checked_with(assignments);
  for (const tasks::SceneBody& body : checked.scene.bodies) {
    const auto penetration = tools::penetration_of(checked.scene, body);
    if (body.name == name) return penetration ? penetration->half_width : 0;
  }
  return -1;
}

std::string warnings_with(const std::vector<std::string>& assignments)
{
  std::string all;
  for (const std::string& line : tools::plausibility_warnings(checked_with(assignments))) all += line + "\n";
  return all;
}

}  // namespace

TEST_CASE("a punch with few cells to its half width is warned of, with cells that are fine enough")
{
  const std::string coarse = warnings_with({}), fine = warnings_with({"/grid/cell_size=0.05"});

  CHECK_THAT(coarse, Catch::Contains("/bodies/punch/geometry: half its width is only 3 cells") &&
                         Catch::Contains("cells of at most 0.05 m"));
  CHECK(fine.empty());
}

TEST_CASE("a body that is cut by a wall is as wide as the whole one")
{
  const std::string half = R"(/bodies/punch/geometry={"type":"box","lower":[0,1],"upper":[0.3,1.5]})";

  CHECK(half_width("punch", {}) == Approx(0.3));
  CHECK(half_width("punch", {half}) == Approx(0.3));
  CHECK(half_width("punch", {half, R"(/boundaries={"x-":"open"})"}) == Approx(0.15));
}

TEST_CASE("a quarter of a body counts by its smaller part")
{
  const double quarter =
      half_width("punch", {"/dimension=3", "/grid/upper=[1,1,2]",
                           R"(/bodies/punch={"material":"steel","velocity":[0,0,-10],
                  "geometry":{"type":"box","lower":[0,0,1],"upper":[0.4,0.3,1.5]}})",
                           R"(/bodies/ground/geometry={"type":"box","lower":[0,0,0],"upper":[1,1,1]})"});

  CHECK(quarter == Approx(0.3));
}

TEST_CASE("what flies aslant is as wide as it is across its way")
{
  const std::string ball = R"(/bodies/punch/geometry={"type":"ball","centre":[1,1.4],"radius":0.25})";

  CHECK(half_width("punch", {ball, "/bodies/punch/velocity=[10,-10]"}) == Approx(0.25));
}

TEST_CASE("of two bodies that meet the stiffer one goes into the other, whichever of them moves")
{
  const std::vector<std::string> thrown{"/bodies/punch/velocity=[0,0]", "/bodies/ground/velocity=[0,10]"};

  CHECK(half_width("punch", thrown) == Approx(0.3));
  CHECK(half_width("ground", thrown) == 0);
}

TEST_CASE("what slides along, flies away, does not arrive or fills the width is on its way into nothing")
{
  const std::string above = R"(/bodies/punch/geometry={"type":"box","lower":[0.7,1.3],"upper":[1.3,1.5]})";

  CHECK(half_width("punch", {"/bodies/punch/velocity=[10,0]"}) == 0);
  CHECK(half_width("punch", {"/bodies/punch/velocity=[0,10]"}) == 0);
  CHECK(half_width("punch", {above, "/bodies/punch/velocity=[0,-2]"}) == 0);
  CHECK(half_width("punch", {above, "/bodies/punch/velocity=[0,-4]"}) == Approx(0.3));
  CHECK(half_width("punch", {R"(/bodies/punch/geometry={"type":"box","lower":[0,1],"upper":[2,1.5]})"}) == 0);
}

}  // namespace test_penetration
