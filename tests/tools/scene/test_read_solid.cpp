#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "components/geometry/closed_mesh.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_read_solid
{

using namespace tamp;
using namespace tamp::test;
using tools::read_scene;

namespace
{

constexpr double pi = std::numbers::pi;

/// Assignments that make the small scene one of three dimensions with this geometry for its block.
std::vector<std::string> in_space(const std::string& geometry)
{
  return {"/dimension=3", "/grid/upper=[2,2,2]", "/grid/cell_size=0.5", "/bodies/block/geometry=" + geometry};
}

components::Solid<3> solid(const std::string& geometry)
{
  const TemporaryFolder folder;
  const auto scene = read_scene(folder.write("small.json", small_scene), in_space(geometry)).scene;
  return std::get<components::Solid<3>>(scene.bodies.at(0).solid);
}

components::Solid<2> plane_solid(const std::string& geometry)
{
  const TemporaryFolder folder;
  const auto scene = read_scene(folder.write("small.json", small_scene), {"/bodies/block/geometry=" + geometry}).scene;
  return std::get<components::Solid<2>>(scene.bodies.at(0).solid);
}

/// Problems of a geometry in 3-D, without the place.
std::string fault(const std::string& geometry)
{
  return problems_with(in_space(geometry));
}

/// Text STL of a tetrahedron with corners (0,0,0), (1,0,0), (0,1,0), (0,0,1), without its first `n_missing` facets.
std::string tetrahedron(int n_missing = 0)
{
  const std::string o = "vertex 0 0 0\n", x = "vertex 1 0 0\n", y = "vertex 0 1 0\n", z = "vertex 0 0 1\n";
  const std::vector<std::string> facets{o + y + x, o + x + z, o + z + y, x + y + z};
  std::string text = "solid tetrahedron\n";
  for (std::size_t i = static_cast<std::size_t>(n_missing); i < facets.size(); ++i) {
    text += "facet normal 0 0 0\nouter loop\n" + facets[i] + "endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

}  // namespace

TEST_CASE("cones, ogives, bodies of revolution and extruded polygons are read")
{
  CHECK(solid(R"({"type":"cone","first_end":[1,1,0],"second_end":[1,1,2],"first_radius":1,"second_radius":0})")
            .volume()
            .value == Approx(2 * pi / 3));
  CHECK(solid(R"({"type":"ogive","tip":[1,1,1],"base":[1,1,0],"radius":1})").volume().value == Approx(2 * pi / 3));
  CHECK(solid(R"({"type":"revolved","start":[1,1,0],"axis":[0,0,2],"profile":[[0,1],[2,1]]})").volume().value ==
        Approx(2 * pi));
  CHECK(solid(R"({"type":"revolved","start":[1,1,0],"axis":[0,0,2],"profile":[[0,0],[2,1]],"tip_radius":0.25})")
            .volume()
            .value == Approx(pi));
  CHECK(solid(R"({"type":"extruded_polygon","corners":[[0,0],[2,0],[0,2]],"lower":1,"upper":2})").volume().value ==
        Approx(2));
  CHECK(plane_solid(R"({"type":"polygon","corners":[[0,0],[2,0],[0,2]]})").volume().value == Approx(2));
}

TEST_CASE("a section is what a solid of space holds of the plane")
{
  const auto square = plane_solid(
      R"({"type":"section","of":{"type":"cylinder","first_end":[1,0.25,0],"second_end":[1,1.25,0],"radius":0.5}})");
  CHECK(square.contains({1.45, 0.5}));
  CHECK_FALSE(square.contains({1.55, 0.5}));
  CHECK_FALSE(square.contains({1, 0.2}));
  CHECK(square.volume().value == Approx(1).epsilon(1e-3));
  const auto disk = plane_solid(R"({"type":"section","of":{"type":"ball","centre":[1,1,0.3],"radius":0.5}})");
  CHECK(disk.contains({1.39, 1}));
  CHECK_FALSE(disk.contains({1.41, 1}));
}

TEST_CASE("the section of what is not quite round is turned with a warning of both volumes")
{
  const auto warnings = [](const std::string& of) {
    const TemporaryFolder folder;
    return read_scene(folder.write("small.json", small_scene),
                      {"/axisymmetric=true", R"(/bodies/block/geometry={"type":"section","of":)" + of + "}"})
        .warnings;
  };

  const auto moved = warnings(R"({"type":"cylinder","first_end":[0,0.5,0.05],"second_end":[0,1.5,0.05],"radius":0.5})");
  const auto round = warnings(R"({"type":"cylinder","first_end":[0,0.5,0],"second_end":[0,1.5,0],"radius":0.5})");

  REQUIRE(moved.size() == 1);
  CHECK_THAT(moved.front(), Catch::StartsWith("/bodies/block/geometry/of: a solid of 0.78") &&
                                Catch::Contains(" m3, whose section holds 0.77"));
  CHECK(round.empty());
}

TEST_CASE("sets of solids nest")
{
  const auto drilled = solid(R"({"type":"difference","of":[
    {"type":"union","of":[{"type":"box","lower":[0,0,0],"upper":[1,2,2]},{"type":"box","lower":[1,0,0],"upper":[2,2,2]}]},
    {"type":"cylinder","first_end":[0,1,1],"second_end":[2,1,1],"radius":0.5}]})");
  const auto lens = plane_solid(R"({"type":"intersection","of":[
    {"type":"ball","centre":[0.5,1],"radius":1},{"type":"ball","centre":[1.5,1],"radius":1}]})");

  CHECK(drilled.volume().value == Approx(8 - pi / 2).epsilon(1e-3));
  CHECK(drilled.contains({1, 0.4, 1}));
  CHECK_FALSE(drilled.contains({1, 0.6, 1}));
  CHECK(lens.volume().value == Approx(2 * pi / 3 - std::sqrt(3) / 2).epsilon(1e-3));
}

TEST_CASE("a solid is turned about the origin and then moved")
{
  const auto bar = solid(R"({"type":"transform","of":{"type":"box","lower":[0,0,0],"upper":[2,1,1]},
    "rotation":{"axis":[0,0,1],"angle":90},"translation":[1.5,0,0.25]})");
  const auto slab = plane_solid(R"({"type":"transform","of":{"type":"box","lower":[0,0],"upper":[2,1]},
    "rotation":{"angle":90},"translation":[1.5,0]})");

  CHECK(bar.bounding_box().lower.isApprox(Vector<3>(0.5, 0, 0.25)));
  CHECK(bar.bounding_box().upper.isApprox(Vector<3>(1.5, 2, 1.25)));
  CHECK(slab.bounding_box().upper.isApprox(Vector<2>(1.5, 2)));
}

TEST_CASE("a ring is one solid several times about an axis")
{
  const auto ring = solid(R"({"type":"transform","translation":[1,1,0],"of":{"type":"ring","count":4,"axis":[0,0,1],
    "of":{"type":"box","lower":[0.25,-0.25,0],"upper":[1,0.25,1]}}})");

  CHECK(ring.volume().value == Approx(4 * 0.75 * 0.5));
  CHECK(ring.contains({1, 1.5, 0.5}));
  CHECK(ring.contains({0.5, 1, 0.5}));
  CHECK_FALSE(ring.contains({1, 1, 0.5}));
}

TEST_CASE("a geometry may stand in a file of its own and be changed in the scene")
{
  const TemporaryFolder folder;
  folder.write("shapes/ball.json", R"({"title":"a ball","type":"ball","centre":[0,0],"radius":0.5})");
  std::string text = small_scene;
  const std::string box = R"({ "type": "box", "lower": [0, 0], "upper": [1, 1] })";
  text.replace(text.find(box), box.size(),
               R"({"type":"transform","of":{"file":"../shapes/ball.json","radius":1},"translation":[1,1]})");

  const auto scene = read_scene(folder.write("scenes/scene.json", text)).scene;

  CHECK(std::get<components::Solid<2>>(scene.bodies.at(0).solid).volume().value == Approx(pi));
  CHECK(problems_of(folder, folder.write("scenes/scene.json", text), {"/bodies/block/geometry/of/radius=-1"}) ==
        "--set#/bodies/block/geometry/of/radius: -1; expected a number above 0 [m]");
  folder.write("shapes/ball.json", R"({"type":"ball","centre":[0]})");
  CHECK(problems_of(folder, folder.write("scenes/scene.json", text)) ==
        "shapes/ball.json#/centre: [0]; expected 2 numbers");
}

TEST_CASE("a geometry that comes to hold itself is reported")
{
  const TemporaryFolder folder;
  folder.write("a.json", R"({"type":"transform","of":{"file":"a.json"}})");

  CHECK_THAT(problems_of(folder, folder.write("scene.json", small_scene),
                         {"/bodies/block/geometry={\"file\":\"" + (folder.path() / "a.json").string() + "\"}"}),
             Catch::Contains("too many solids, one within the other; expected a file that does not name itself"));
}

TEST_CASE("what is wrong with a solid is reported where it stands")
{
  CHECK(fault(R"({"type":"revolved","start":[1,1,0],"axis":[0,0,1],"profile":[[0,1],[1,1],[0.5,1]]})") ==
        "--set#/bodies/block/geometry/profile/2: a profile that goes from 1.000000 to 0.500000; expected places that "
        "grow from row to row");
  CHECK(fault(R"({"type":"extruded_polygon","corners":[[0,0],[1,1],[1,0],[0,1]],"lower":0,"upper":1})") ==
        "--set#/bodies/block/geometry/corners/2: the edge from [1, 0] to [0, 1] meets that from [0, 0] to [1, 1]; "
        "expected a polygon that does not cross itself");
  CHECK(fault(R"({"type":"revolved","start":[1,1,0],"axis":[0,0,1],"profile":[[0,1],[1]]})") ==
        "--set#/bodies/block/geometry/profile: [[0,1],[1]]; expected a list of lists of 2 numbers");
  CHECK(fault(R"({"type":"union","of":[{"type":"box","lower":[0,0,0],"upper":[1,1,1]},{"type":"bal"}]})") ==
        "--set#/bodies/block/geometry/of/1/type: \"bal\"; expected one of box, ball, rotated_box, cylinder, cone, "
        "ogive, revolved, extruded_polygon, mesh, union, intersection, difference, transform, ring, did you mean "
        "\"ball\"?");
  CHECK(fault(R"({"type":"union","of":[]})") == "--set#/bodies/block/geometry: no solids; expected 1 or more");
  CHECK(fault(R"({"type":"ring","count":2,"axis":[0,0,0],"of":{"type":"box","lower":[0,0,0],"upper":[1,1,1]}})") ==
        "--set#/bodies/block/geometry: axis [0, 0, 0]; expected an axis with a direction");
  CHECK(fault(R"({"type":"transform","translation":[0,0,0]})") ==
        "--set#/bodies/block/geometry/of: missing; expected an object");
  CHECK_THAT(problems_with({R"(/bodies/block/geometry={"type":"cylinder"})"}),
             Catch::StartsWith("--set#/bodies/block/geometry/type: \"cylinder\"; expected one of box, ball"));
}

TEST_CASE("a mesh is read, scaled, and told when it is open, damaged or not there")
{
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", small_scene);
  const std::string stl = (folder.path() / "shape.stl").string();
  const auto geometry = in_space(R"({"type":"mesh","stl":")" + stl + R"(","scale":2})");

  CHECK_THAT(problems_of(folder, scene, geometry),
             Catch::StartsWith("--set#/bodies/block/geometry/stl: there is no file"));
  folder.write("shape.stl", tetrahedron());
  if (!components::ClosedMesh::is_available) {
    CHECK_THAT(problems_of(folder, scene, geometry), Catch::EndsWith("expected a build with -DTAMP_MESHES=ON"));
    return;
  }
  const auto read = read_scene(scene, geometry).scene;
  CHECK(std::get<components::Solid<3>>(read.bodies.at(0).solid).volume().value == Approx(8.0 / 6));
  folder.write("shape.stl", tetrahedron(1));
  CHECK_THAT(
      problems_of(folder, scene, geometry),
      Catch::StartsWith("--set#/bodies/block/geometry: shape.stl holds an open surface: 3 edges have one triangle") &&
          Catch::EndsWith("; expected a closed surface that does not cross itself"));
  folder.write("shape.stl", "solid nothing");
  CHECK(problems_of(folder, scene, geometry) ==
        "--set#/bodies/block/geometry: shape.stl holds no STL, or one that is damaged; expected triangles in STL, "
        "binary or text");
}

}  // namespace test_read_solid
