#include <catch2/catch.hpp>

#include "tests/tools/scene/small_scene.hpp"

namespace test_bad_scenes
{

using namespace tamp::test;

namespace
{

/// A scene of its own: the folder "scenes" beside the sand and its tables.
std::string problems_with_sand(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  write_sand(folder);
  std::string scene = small_scene;
  scene.replace(scene.find("\"steel\": {"), 0, R"("sand": { "file": "../sand.json", "density": 1500 }, )");
  return problems_of(folder, folder.write("scenes/scene.json", scene), assignments);
}

/// The problems of the scene with sand when one of its tables holds this.
std::string problems_with_table(const std::string& table, const std::string& content)
{
  const TemporaryFolder folder;
  write_sand(folder);
  folder.write("tables/" + table, content);
  std::string scene = small_scene;
  scene.replace(scene.find("\"steel\": {"), 0, R"("sand": { "file": "../sand.json", "density": 1500 }, )");
  return problems_of(folder, folder.write("scenes/scene.json", scene));
}

std::string problems_of_text(const std::string& text)
{
  const TemporaryFolder folder;
  return problems_of(folder, folder.write("scene.json", text));
}

}  // namespace

TEST_CASE("a small scene and a small sand are sound")
{
  CHECK(problems_with({}) == "");
  CHECK(problems_with_sand({}) == "");
}

TEST_CASE("text that is not JSON is told with line and column")
{
  CHECK_THAT(problems_of_text("{\n  \"dimension\": 2,,\n}"),
             Catch::StartsWith("scene.json:2:18: ") && Catch::EndsWith("; expected JSON"));
}

TEST_CASE("NaN is no JSON and no number")
{
  CHECK_THAT(problems_of_text("{\"dimension\": NaN}"), Catch::StartsWith("scene.json:1:15: "));
  CHECK(problems_with({"/time/end=NaN"}) == "--set#/time/end: \"NaN\"; expected a number above 0 [s]");
}

TEST_CASE("a number too large for a double is told")
{
  CHECK_THAT(problems_of_text("{\"dimension\": 1e999}"), Catch::StartsWith("scene.json") && Catch::Contains("1e999"));
}

TEST_CASE("a key that is given twice is told with its place")
{
  CHECK(problems_of_text(R"({"list": [1, {"a": 1, "b": 2, "a": 3}]})") ==
        "scene.json#/list/1/a: the key is given twice; expected it once");
}

TEST_CASE("a scene that is no object is told")
{
  CHECK(problems_of_text("[]") == "scene.json#: array; expected an object");
}

TEST_CASE("a missing key is told with its place and unit")
{
  CHECK(problems_with({"/grid/cell_size=null"}) == "--set#/grid/cell_size: missing; expected a number above 0 [m]");
  const std::string problems = problems_of_text("{}");
  CHECK_THAT(problems, Catch::Contains("scene.json#/dimension: missing; expected a whole number from 2 to 3"));
  CHECK_THAT(problems, Catch::Contains("scene.json#/grid: missing; expected an object"));
  CHECK_THAT(problems, Catch::Contains("scene.json#/materials: missing; expected an object"));
  CHECK_THAT(problems, Catch::Contains("scene.json#/bodies: missing; expected an object"));
}

TEST_CASE("a misspelt key is told with the nearest known one")
{
  const TemporaryFolder folder;
  std::string scene = small_scene;
  scene.replace(scene.find("\"dimension\""), 0, "\"gravty\": [0, 0], ");

  CHECK(problems_of(folder, folder.write("scene.json", scene)) ==
        "scene.json#/gravty: unknown key; did you mean \"gravity\"?");
}

TEST_CASE("an unknown key that resembles none is told with those there are")
{
  CHECK(problems_with({"/artificial_viscosity/bulk=1"}) ==
        "--set#/artificial_viscosity/bulk: unknown key; expected one of linear, quadratic");
}

TEST_CASE("a value of the wrong type is told with what was found")
{
  CHECK(problems_with({"/time/end=[1]"}) == "--set#/time/end: [1]; expected a number above 0 [s]");
  CHECK(problems_with({"/dimension=2.5"}) == "--set#/dimension: 2.5; expected a whole number from 2 to 3");
  CHECK(problems_with({"/boundaries=[]"}) == "--set#/boundaries: []; expected an object");
  CHECK(problems_with({"/title=3"}) == "--set#/title: 3; expected a text");
  CHECK(problems_with({"/gravity=[0]"}) == "--set#/gravity: [0]; expected 2 numbers");
  CHECK(problems_with({"/contact={}"}) == "--set#/contact: an object; expected a list");
  CHECK(problems_with({"/contact=[1]"}) == "--set#/contact/0: 1; expected an object");
}

TEST_CASE("a key of one transfer is refused with another")
{
  CHECK(problems_with({"/flip_part=0.9"}) ==
        "--set#/flip_part: a key that another transfer has; expected the transfer blend with it");
  CHECK(problems_with({"/transfer=blend", "/filter_order=2"}) ==
        "--set#/filter_order: a key that another transfer has; expected the transfer xpic or fmpm with it");
  CHECK(problems_with({"/transfer=blend", "/flip_part=1.5"}) == "--set#/flip_part: 1.5; expected a number from 0 to 1");
  CHECK(problems_with({"/transfer=fmpm", "/filter_order=101"}) ==
        "--set#/filter_order: 101; expected a whole number from 1 to 100");
  CHECK(problems_with({"/transfer=xpic", "/filter_order=12"}) == "");
  CHECK(problems_with({"/transfer=apic"}) == "");
  CHECK(
      problems_with({"/transfer=apic", "/interpolator=linear", "/time/rule=published"}) ==
      "--set#/transfer: apic with an interpolator whose weights have no spread where a particle is on a node; expected "
      "another transfer, such as tpic, or another interpolator");
}

TEST_CASE("a number out of range is told with its range")
{
  CHECK(problems_with({"/materials/steel/density=-8000"}) ==
        "--set#/materials/steel/density: -8000; expected a number above 0 [kg/m^3]");
  CHECK(problems_with({"/time/multiplier=1.5"}) ==
        "--set#/time/multiplier: 1.5; expected a number above 0 and up to 1");
  CHECK(problems_with({"/time/maximum_step=1e-13"}) ==
        "--set#/time/maximum_step: 1e-13; expected no less than the minimum step, 1e-12");
  CHECK(problems_with({"/particles_per_cell=[0,0]"}) ==
        "--set#/particles_per_cell: [0,0]; expected 2 whole numbers from 1 to 16");
  CHECK(problems_with({"/particles_per_cell=[2,3]"}) ==
        "--set#/particles_per_cell: unequal numbers; expected the same number along every axis");
}

TEST_CASE("a centrifuge whose numbers make no rotation is told, and one in the plane")
{
  CHECK(problems_with({R"(/centrifuge={"angular_speed":6})"}) ==
        "--set#/centrifuge: a plane scene; expected one of dimension 3");

  const auto in_space = [](const std::string& centrifuge) {
    return problems_with({"/dimension=3", "/grid/upper=[2,2,2]",
                          R"(/bodies/block/geometry={"type":"box","lower":[0,0,0],"upper":[1,1,1]})",
                          "/centrifuge=" + centrifuge});
  };
  CHECK(in_space(R"({"angular_speed":6,"axis":[1,0,0],"centre":[0,0,5]})") == "");
  CHECK(in_space(R"({"angular_speed":6,"axis":[0,0,0],"centre":[0,0,5]})") ==
        "--set#/centrifuge/axis: an axis of zero length; expected a direction");
  CHECK(in_space(R"({"angular_speed":-6,"axis":[1,0,0],"centre":[0,0,5]})") ==
        "--set#/centrifuge/angular_speed: -6; expected a number of 0 or above [rad/s]");
  CHECK_THAT(in_space(R"({"angular_speed":6,"axis":["NaN",0,0],"centre":[0,0,5]})"),
             Catch::StartsWith("--set#/centrifuge/axis"));
}

TEST_CASE("a body that cannot have settled is told why")
{
  CHECK(problems_with({"/bodies/block/initial_stress=true"}) ==
        "--set#/bodies/block/initial_stress: material \"steel\"; expected a material of type tabular_cap");
  CHECK(problems_with_sand({"/bodies/block/material=sand", "/bodies/block/initial_stress=true"}) ==
        "--set#/bodies/block/initial_stress: a body not between walls along xy; expected sides and floor on walls, and "
        "one free face");
  CHECK_THAT(problems_with_sand({"/bodies/block/material=sand", "/bodies/block/initial_stress=true",
                                 "/bodies/block/geometry/upper=[2,1]", "/gravity=[0,1e7]"}),
             Catch::StartsWith("--set#/bodies/block/initial_stress: q = ") &&
                 Catch::Contains("at most the sand's strength there"));
}

TEST_CASE("sand that cannot have settled as it has a gap is told")
{
  const std::string two_layers = R"({"type":"difference","of":[{"type":"box","lower":[0,0],"upper":[2,1.5]},)"
                                 R"({"type":"box","lower":[0,0.5],"upper":[2,1]}]})";

  CHECK(problems_with_sand({"/bodies/block/material=sand", "/bodies/block/initial_stress=true",
                            "/bodies/block/geometry=" + two_layers, "/gravity=[0,-10]"}) ==
        "--set#/bodies/block/initial_stress: a region with a gap along y; expected a box");
}

TEST_CASE("settled sand that moves or is rigid is told")
{
  const auto problems = [](const std::string& assignment) {
    return problems_with_sand({"/bodies/block/material=sand", "/bodies/block/initial_stress=true",
                               "/bodies/block/geometry/upper=[2,1]", "/gravity=[0,-10]", assignment});
  };

  CHECK(problems("/bodies/block/velocity=[0,0]") == "");
  CHECK(problems("/bodies/block/velocity=[0,1]") ==
        "--set#/bodies/block/initial_stress: a body with a velocity; expected one at rest");
  CHECK(problems("/bodies/block/angular_velocity=[1]") ==
        "--set#/bodies/block/initial_stress: a body with a velocity; expected one at rest");
  CHECK(problems("/bodies/block/rigid=true") ==
        "--set#/bodies/block/initial_stress: a rigid body, which has no stress; expected one that is not rigid");
}

TEST_CASE("FMPM where contact or a wall would give particles energy is told")
{
  const std::string other = R"("other":{"material":"soil","geometry":{"type":"box","lower":[0,1],"upper":[1,2]}})";
  const std::vector<std::string> two{R"(/materials/soil={"type":"hypoelastic","density":1,"bulk_modulus":1,)"
                                     R"("shear_modulus":1})",
                                     "/bodies/other=" + other.substr(8), "/transfer=fmpm"};
  const auto with = [&](const std::string& more) {
    std::vector<std::string> all = two;
    all.push_back(more);
    return problems_with(all);
  };

  CHECK(problems_with({"/transfer=fmpm", "/boundaries/y-/friction=0.3"}) ==
        "--set#/transfer: fmpm of order 2 with a wall that rubs; expected another transfer, as particles would gain "
        "energy where the wall stops nodes");
  CHECK(problems_with({"/transfer=fmpm", "/filter_order=1", "/boundaries/y-/friction=0.3"}) == "");
  CHECK_THAT(with("/title=two"), Catch::StartsWith("--set#/transfer: fmpm of order 2 with materials that do not meet"));
  CHECK_THAT(with(R"(/contact=[{"materials":["steel","soil"],"friction":0}])"),
             Catch::StartsWith("--set#/transfer: fmpm of order 2 with materials that do not meet"));
  CHECK(with(R"(/contact=[{"materials":["steel","soil"],"friction":0,"normal":"regression"}])") == "");
}

TEST_CASE("rings of particles in what is no disk, or where a problem lays them out, are told")
{
  const std::string at = "--set#/bodies/block/particles: ", disk = R"({"type":"ball","centre":[1,1],"radius":0.7})";

  CHECK(problems_with({"/bodies/block/particles=rings"}) ==
        at + "rings, of a body that is no disk; expected a \"ball\" in two dimensions");
  CHECK(problems_with({"/bodies/block/particles=rings", "/bodies/block/geometry=" + disk,
                       R"(/bodies/block/problem={"type":"rotating_disk","centre":[1,1],"outer_radius":0.7,)"
                       R"("angular_speed":1})"}) ==
        at + "rings, of a body with a problem; expected those of the problem alone");
}

TEST_CASE("rigid bodies whose contact nothing could tell are told")
{
  const std::string body = R"({"material":"steel","rigid":true,"geometry":{"type":"box",)";
  std::vector<std::string> scene{"/grid/upper=[9,9]", "/bodies/block=" + body + R"("lower":[2,2],"upper":[3,3]}})"};
  const auto problems = [&](const std::string& assignment) {
    scene.push_back(assignment);
    return problems_with(scene);
  };
  CHECK(problems_with(scene) == "");

  SECTION("of one particle")
  {
    CHECK(
        problems("/particles_per_cell=[1,1]") ==
        "--set#/bodies/block/rigid: a rigid body of one particle; expected two or more, so that it has an orientation");
  }
  SECTION("of another's material")
  {
    CHECK_THAT(problems("/bodies/other=" + body + R"("lower":[6,6],"upper":[7,7]}})"),
               Catch::Contains("#/bodies/block: rigid, but of one material with body \"other\"; expected a material of "
                               "its own"));
  }
  SECTION("at an edge")
  {
    CHECK(problems("/bodies/block/geometry/lower=[0,2]") ==
          "--set#/bodies/block: rigid, and less than a cell from the edge of the grid; expected all nodes that it "
          "reaches to lie within the grid, but for \"symmetry\" faces along which it is driven without turning");
  }
  SECTION("beside another")
  {
    scene.push_back(R"(/materials/iron={"type":"hypoelastic","density":8000,"bulk_modulus":10e9,"shear_modulus":7e9})");
    const auto other = [&](int lower) {
      const std::string left = std::to_string(lower), right = std::to_string(lower + 1);
      return "/bodies/other=" + body + R"("lower":[)" + left + R"(,2],"upper":[)" + right + R"(,3]}})";
    };
    scene.push_back(other(3));
    CHECK_THAT(
        problems(R"(/bodies/other/material="iron")"),
        Catch::Contains("so near to the rigid body \"block\" that they meet; expected one of them to be deformable"));
    scene.push_back(other(4));
    CHECK(problems(R"(/bodies/other/material="iron")") == "");
  }
}

TEST_CASE("a driven body is rigid, is driven in one way, and starts as it is driven")
{
  const std::string driven = "/bodies/block/driven", block = "--set#/bodies/block";
  const auto problems = [&](const std::string& how, const std::string& more = "/title=driven") {
    return problems_with({"/grid/upper=[9,9]", "/bodies/block/rigid=true", "/bodies/block/geometry/lower=[2,2]",
                          "/bodies/block/geometry/upper=[3,3]", driven + "=" + how, more});
  };
  CHECK(problems(R"({"velocity":[0,-1]})") == "");
  CHECK(problems(R"({"velocities":[[0,0,0],[1,0,-1]],"rotation":"free"})", "/bodies/block/angular_velocity=[1]") == "");
  CHECK(problems(R"({"displacements":[[0,0,0],[1,0,-1]]})") == "");

  CHECK(problems(R"({"velocity":[0,-1]})", "/bodies/block/rigid=false") ==
        block + "/driven: a body that is not rigid; expected a rigid one");
  CHECK(problems("{}") ==
        block + "/driven/velocity: 0 of the keys for it; expected one of velocity, velocities and displacements");
  CHECK(problems(R"({"velocity":[0,-1],"displacements":[[0,0,0],[1,0,-1]]})") ==
        block + "/driven/velocity: 2 of the keys for it; expected one of velocity, velocities and displacements");
  CHECK(problems(R"({"velocity":[0]})") == block + "/driven/velocity: [0]; expected 2 numbers");
  CHECK_THAT(problems(R"({"velocities":[[0,-1]]})"), Catch::Contains("expected a list of lists of 3 numbers"));
  CHECK(problems(R"({"velocities":[[1,0,0],[1,0,-1]]})") ==
        block + "/driven/velocities: 1.000000 s after 1.000000 s; expected times that ascend");
  CHECK(problems(R"({"displacements":[[0,0,1],[1,0,-1]]})") ==
        block + "/driven/displacements: a first displacement that is not 0; expected the body to start where it is");
  CHECK(problems(R"({"velocity":[0,-1],"rotation":"loose"})") ==
        block + "/driven/rotation: \"loose\"; expected one of held, free");
  CHECK(problems(R"({"velocity":[0,-1]})", "/bodies/block/velocity=[0,-1]") ==
        block + "/velocity: a driven body's; expected the motion under the key driven alone");
  CHECK(problems(R"({"velocity":[0,-1]})", "/bodies/block/angular_velocity=[1]") ==
        block + "/angular_velocity: a driven body's; expected the motion under the key driven alone");
}

TEST_CASE("a driven body may lie against a mirror along which it goes without turning, and against no other face")
{
  const auto problems = [](const std::string& how, const std::string& face = "symmetry") {
    return problems_with({"/grid/upper=[9,9]", "/bodies/block/rigid=true", "/bodies/block/geometry/lower=[0,2]",
                          "/bodies/block/geometry/upper=[1,3]", "/boundaries/x-=" + face,
                          "/bodies/block/driven=" + how});
  };
  const auto is_refused = Catch::Contains("#/bodies/block: rigid, and less than a cell from the edge");

  CHECK(problems(R"({"velocity":[0,-1]})") == "");
  CHECK_THAT(problems(R"({"velocity":[1,-1]})"), is_refused);
  CHECK_THAT(problems(R"({"velocity":[0,-1],"rotation":"free"})"), is_refused);
  CHECK_THAT(problems(R"({"velocity":[0,-1]})", "open"), is_refused);
}

TEST_CASE("a pressure load pushes on a surface of a body that is not rigid")
{
  // The block of 1 m x 1 m lies against walls on its left and below it.
  const std::string pressure = "--set#/bodies/block/pressure";
  const auto problems = [](const std::string& load, const std::string& more = "/title=pressed") {
    return problems_with({"/bodies/block/pressure=" + load, more});
  };
  CHECK(problems(R"({"value":1e3})") == "");
  CHECK(problems(R"({"values":[[0,0],[1,1e3]],"within":{"lower":[-1,0.99],"upper":[1,2]}})") == "");
  CHECK(problems("null") == "");

  CHECK(problems("1000") == pressure + ": 1000; expected an object");
  CHECK(problems(R"({})") == pressure + "/value: neither value nor values; expected one of value and values");
  CHECK(problems(R"({"value":1,"values":[[0,1]]})") ==
        pressure + "/value: beside values; expected one of value and values");
  CHECK(problems(R"({"value":-1})") == pressure + "/value: -1; expected a number of 0 or above [Pa]");
  CHECK(problems(R"({"value":"much"})") == pressure + "/value: \"much\"; expected a number of 0 or above [Pa]");
  CHECK(problems(R"({"values":[[0,1],[0,2]]})") ==
        pressure + "/values: entry 1: 0.000000 s after 0.000000 s; expected times that ascend");
  CHECK(problems(R"({"values":[[0,1],[1,-2]]})") ==
        pressure + "/values: entry 1: -2.000000 Pa; expected a pressure of 0 or above");
  CHECK(problems(R"({"values":[]})") == pressure + "/values: no point; expected one or more");
  CHECK_THAT(problems(R"({"values":[[0,1,2]]})"), Catch::Contains("expected a list of lists of 2 numbers"));
  CHECK(problems(R"({"value":1,"within":{"lower":[0,0],"upper":[1,0]}})") ==
        pressure + "/within/upper: 0 along y; expected more than lower, 0");
  CHECK_THAT(problems(R"({"value":1,"within":{"lower":[0,0]}})"),
             Catch::StartsWith(pressure + "/within/upper: missing"));
  CHECK_THAT(problems(R"({"value":1,"side":"top"})"), Catch::StartsWith(pressure + "/side: unknown key"));
  const std::string surface = "; expected a box that holds some of the body's surface";
  CHECK(problems(R"({"value":1,"within":{"lower":[5,5],"upper":[6,6]}})") ==
        pressure + "/within: from [5, 5] to [6, 6]" + surface);
  CHECK(problems(R"({"value":1,"within":{"lower":[0.1,0.1],"upper":[0.9,0.9]}})") ==
        pressure + "/within: from [0.1, 0.1] to [0.9, 0.9]" + surface);
  // A wall is no surface, but an open face is.
  CHECK(problems(R"({"value":1,"within":{"lower":[-1,-1],"upper":[0.1,0.9]}})") ==
        pressure + "/within: from [-1, -1] to [0.1, 0.9]" + surface);
  CHECK(problems(R"({"value":1,"within":{"lower":[-1,-1],"upper":[0.1,0.9]}})", R"(/boundaries/x-="open")") == "");
  CHECK(problems(R"({"value":1})", "/bodies/block/geometry/upper=[2,2]") ==
        pressure + ": a body without a surface, between walls; expected one with a free side");
  CHECK(problems_with({"/grid/upper=[9,9]", "/bodies/block/geometry/lower=[2,2]", "/bodies/block/geometry/upper=[3,3]",
                       "/bodies/block/rigid=true", R"(/bodies/block/pressure={"value":1})"}) ==
        pressure + ": a rigid body, which bears no stress; expected one that is not rigid");
}

TEST_CASE("fields to be written are named once each, and of the scene's materials")
{
  const std::string expected =
      "; expected a list of some of position, velocity, stress, p, q, density, J, "
      "nodes/density, nodes/velocity";
  CHECK(problems_with({R"(/output/fields=["p","nodes/density","J"])"}) == "");
  CHECK(problems_with({"/output/fields=[]"}) == "");
  CHECK(problems_with({R"(/output/fields="p")"}) == "--set#/output/fields: \"p\"" + expected);
  CHECK(problems_with({"/output/fields=[1]"}) == "--set#/output/fields: [1]" + expected);
  CHECK(problems_with({R"(/output/fields=["p","p"])"}) == "--set#/output/fields: \"p\" twice" + expected);
  CHECK_THAT(problems_with({R"(/output/fields=["velocty"])"}),
             Catch::StartsWith("--set#/output/fields: \"velocty\"" + expected) && Catch::Contains("velocity\"?"));
  CHECK_THAT(problems_with({R"(/output/fields=["equivalent_plastic"])"}), Catch::Contains("\"equivalent_plastic\""));
}

TEST_CASE("local damping is a part of a force")
{
  CHECK(problems_with({"/local_damping=0.3"}) == "");
  CHECK_THAT(problems_with({"/local_damping=1"}), Catch::StartsWith("--set#/local_damping: 1; expected a number"));
  CHECK_THAT(problems_with({"/local_damping=-0.1"}),
             Catch::StartsWith("--set#/local_damping: -0.1; expected a number"));
}

TEST_CASE("a wall has a word or a coefficient of friction, which no turning grid has")
{
  CHECK(problems_with({R"(/boundaries/y-="no_slip")"}) == "");
  CHECK(problems_with({R"(/boundaries/y-={"friction":0.4})"}) == "");
  CHECK(problems_with({R"(/boundaries/y-="rough")"}) ==
        "--set#/boundaries/y-: \"rough\"; expected one of symmetry, open, no_slip, periodic, {\"friction\": MU}");
  CHECK_THAT(problems_with({R"(/boundaries/y-={"friction":-0.4})"}),
             Catch::StartsWith("--set#/boundaries/y-/friction: -0.4; expected a number"));
  CHECK_THAT(problems_with({R"(/boundaries/y-={})"}), Catch::Contains("#/boundaries/y-/friction: missing"));
  CHECK_THAT(problems_with({R"(/boundaries/y-={"friction":0.4,"slip":1})"}),
             Catch::Contains("#/boundaries/y-/slip: unknown key"));
  const std::vector<std::string> in_space{"/dimension=3", "/grid/upper=[2,2,2]", "/bodies/block/geometry/lower=[0,0,0]",
                                          "/bodies/block/geometry/upper=[1,1,1]",
                                          R"(/boundaries={"x-":{"friction":0.4},"z-":{"friction":0.4}})"};
  std::vector<std::string> turning = in_space;
  turning.push_back(R"(/centrifuge={"angular_speed":1,"axis":[0,1,0],"centre":[0,0,0]})");
  CHECK(problems_with(in_space) == "");
  CHECK(problems_with(turning) ==
        "--set#/centrifuge: a wall with friction; expected other boundaries where the grid turns");
}

TEST_CASE("both faces of an axis are periodic or neither, and three cells apart")
{
  const std::string around = R"(/boundaries={"x-":"periodic","x+":"periodic"})";
  CHECK(problems_with({"/grid/upper=[3,2]", around}) == "");
  CHECK(problems_with({R"(/boundaries={"x+":"periodic"})"}) ==
        "--set#/boundaries/x-: a face that is not periodic, opposite to one that is; expected both faces of an axis "
        "periodic, or neither");
  CHECK(problems_with({R"(/boundaries={"y-":"periodic","y+":{"friction":0.4}})"}) ==
        "--set#/boundaries/y+: a face that is not periodic, opposite to one that is; expected both faces of an axis "
        "periodic, or neither");
  CHECK(problems_with({around}) ==
        "--set#/boundaries/x-: periodic, 2 cells along x; expected at least 3 cells between periodic faces");
  CHECK_THAT(problems_with({R"(/boundaries={"z-":"periodic","z+":"periodic"})"}),
             Catch::Contains("#/boundaries/z-: unknown key"));
}

TEST_CASE("what cannot go around is refused between periodic faces")
{
  const auto problems = [](const std::string& first, const std::string& second = "/title=around") {
    return problems_with({"/grid/upper=[9,9]", "/bodies/block/geometry/lower=[2,2]",
                          "/bodies/block/geometry/upper=[5,5]", R"(/boundaries={"y-":"periodic","y+":"periodic"})",
                          first, second});
  };
  CHECK(problems("/bodies/block/velocity=[0,1]") == "");
  CHECK(
      problems("/bodies/block/rigid=true") ==
      "--set#/bodies/block/rigid: a rigid body, which cannot go around, between periodic boundaries; expected one that "
      "is not rigid, or other boundaries");
  CHECK(problems("/bodies/block/nose=[3,2]", "/bodies/block/tail=[3,5]") ==
        "--set#/bodies/block/nose: a nose, whose surroundings cannot go around, between periodic boundaries; expected "
        "none, or other boundaries");
  CHECK(problems_with_sand({"/grid/upper=[3,2]", R"(/boundaries={"x-":"periodic","x+":"periodic"})",
                            R"(/contact=[{"materials":["steel","sand"],"friction":0,"normal":"regression"}])"}) ==
        "--set#/contact/0/normal: regression, whose planes have one place each, between periodic boundaries; expected "
        "another normal");
  CHECK(problems_with({"/dimension=3", "/grid/upper=[3,2,2]", "/bodies/block/geometry/lower=[0,0,0]",
                       "/bodies/block/geometry/upper=[1,1,1]", R"(/boundaries={"x-":"periodic","x+":"periodic"})",
                       R"(/centrifuge={"angular_speed":1,"axis":[1,0,0],"centre":[0,0,0]})"}) ==
        "--set#/centrifuge: periodic boundaries, whose ends are not alike in a turning grid; expected other boundaries "
        "where the grid turns");
}

TEST_CASE("what a rigid body is given of a wrong type is told with what was found")
{
  CHECK(problems_with({"/bodies/block/rigid=1"}) == "--set#/bodies/block/rigid: 1; expected true or false");
  CHECK(problems_with({"/bodies/block/angular_velocity=[1,2,3]"}) ==
        "--set#/bodies/block/angular_velocity: [1,2,3]; expected 1 numbers");
  CHECK(problems_with({"/bodies/block/nose=[1]", "/bodies/block/tail=[0,0]"}) ==
        "--set#/bodies/block/nose: [1]; expected 2 numbers");
  CHECK(problems_with({"/bodies/block/nose=[0,0]"}) == "scene.json#/bodies/block/tail: missing; expected 2 numbers");
  CHECK(problems_with({"/bodies/block/nose=[1,1]", "/bodies/block/tail=[1,1]"}) ==
        "--set#/bodies/block/tail: [1, 1]; expected another place than the nose's");
  CHECK(problems_with({"/materials/steel/particles_per_axis=2.5"}) ==
        "--set#/materials/steel/particles_per_axis: 2.5; expected a whole number from 1 to 16");
  CHECK(problems_with({"/materials/steel/particles_per_axis=0"}) ==
        "--set#/materials/steel/particles_per_axis: 0; expected a whole number from 1 to 16");
  const auto normal = [](const std::string& of) {
    return problems_with_sand({R"(/contact=[{"materials":["steel","sand"],"friction":0,"normal":)" + of + "}]"});
  };
  CHECK(normal("\"sand\"") == "");
  CHECK(normal("\"snd\"") ==
        "--set#/contact/0/normal: \"snd\"; expected one of flatter, regression, steel, sand, did you mean \"sand\"?");
  CHECK(normal("1") == "--set#/contact/0/normal: 1; expected one of flatter, regression, steel, sand");
}

TEST_CASE("a nose or a tail that is not of its body is told")
{
  const auto problems = [](const std::string& nose, const std::string& tail) {
    return problems_with({"/bodies/block/nose=" + nose, "/bodies/block/tail=" + tail});
  };

  CHECK(problems("[0.5,0]", "[0.5,1]") == "");
  CHECK(problems("[0,0]", "[1,1]") == "");
  CHECK(problems("[0.5,-0.6]", "[0.5,1]") ==
        "--set#/bodies/block/nose: [0.5, -0.6]; expected a place within the body or on its surface");
  CHECK(problems("[0.5,0]", "[1.6,1]") ==
        "--set#/bodies/block/tail: [1.6, 1]; expected a place within the body or on its surface");
}

TEST_CASE("a projectile that starts inside the sand is told with where")
{
  const auto problems = [](const std::string& translation) {
    const TemporaryFolder folder;
    return problems_of(folder, TAMP_SOURCE_DIR "/inputs/uxo/quick.json",
                       {"/bodies/projectile/geometry/translation=" + translation, "/bodies/projectile/nose=null",
                        "/bodies/projectile/tail=null"});
  };

  CHECK(problems("[0.045,0.05,0.1085]") == "");
  CHECK_THAT(problems("[0.045,0.05,0.106]"), Catch::Contains("#/bodies/sand: overlaps body \"projectile\", at [0.04") &&
                                                 Catch::Contains("; expected bodies that share no particle"));
}

TEST_CASE("an elastic material without stiffness is refused")
{
  for (const char* type : {"hypoelastic", "neo_hookean", "neo_hookean_log"}) {
    CHECK(problems_with({std::string("/materials/steel/type=") + type, "/materials/steel/bulk_modulus=0"}) ==
          "--set#/materials/steel/bulk_modulus: 0; expected a number above 0 [Pa]");
    CHECK(problems_with({std::string("/materials/steel/type=") + type, "/materials/steel/shear_modulus=-1"}) ==
          "--set#/materials/steel/shear_modulus: -1; expected a number above 0 [Pa]");
  }
}

TEST_CASE("soil whose numbers do not go together is refused, with the one that does not")
{
  const auto problems = [](const std::string& keys) {
    return problems_with(
        {"/materials/steel={\"type\": \"drucker_prager\", \"density\": 1600, \"bulk_modulus\": 1e7, "
         "\"shear_modulus\": 1e7" +
         keys + "}"});
  };
  const std::string friction = ", \"friction_angle\": 30";

  CHECK(problems(friction) == "");
  CHECK_THAT(problems(""),
             Catch::EndsWith("#/materials/steel/friction_angle: missing; expected a number from 0 to below "
                             "90 [degrees]"));
  CHECK(problems(friction + ", \"dilation_angle\": 31") ==
        "--set#/materials/steel/dilation_angle: 31; expected at most the friction angle, 30: more would gain energy by "
        "flowing");
  CHECK(problems(friction + ", \"cohesion\": 1e4, \"tension_cutoff\": 2e4") ==
        "--set#/materials/steel/tension_cutoff: 20000; expected at most 17320.5 Pa, where the cone ends");
  CHECK(problems(friction + ", \"cohesion\": \"much\"") ==
        "--set#/materials/steel/cohesion: \"much\"; expected a number of 0 or above [Pa]");
}

TEST_CASE("sand that separates at no density, or perhaps, is refused")
{
  const auto problems = [](const std::string& assignment) {
    const TemporaryFolder folder;
    return problems_of(folder, TAMP_SOURCE_DIR "/inputs/punch/quick.json", {"/materials/sand/" + assignment});
  };

  CHECK(problems("separation=true") == "");
  CHECK(problems("separation_density=1") == "");
  CHECK(problems("separation=perhaps") == "--set#/materials/sand/separation: \"perhaps\"; expected true or false");
  CHECK(problems("separation_density=0") ==
        "--set#/materials/sand/separation_density: 0; expected a number above 0 and up to 1");
}

TEST_CASE("sand that has to forget its gradients is not updated before it has them")
{
  const auto problems = [](const std::vector<std::string>& assignments) {
    const TemporaryFolder folder;
    return problems_of(folder, TAMP_SOURCE_DIR "/inputs/punch/quick.json", assignments);
  };
  const std::string tflip = "/transfer=tflip", usf = "/stress_timing=usf", apart = "/materials/sand/separation=true";

  CHECK(problems({tflip, usf, apart}) ==
        "--set#/stress_timing: \"usf\" with the transfer tflip and sand that separates, \"sand\"; expected usl or "
        "musl, as sand that is apart has to forget the gradient of its velocity, which with usf it only gets after its "
        "stress; or another transfer");
  CHECK(problems({tflip, usf}) == "");
  CHECK(problems({usf, apart}) == "");
  CHECK(problems({tflip, "/stress_timing=musl", apart}) == "");
}

TEST_CASE("a name that is none of the choices is told with the choices")
{
  CHECK(problems_with({"/materials/steel/type=hypoelastik"}) ==
        "--set#/materials/steel/type: \"hypoelastik\"; expected one of hypoelastic, neo_hookean, neo_hookean_log, "
        "drucker_prager, tabular_cap, did you mean \"hypoelastic\"?");
  CHECK(problems_with({"/interpolator=quintic_spline"}) ==
        "--set#/interpolator: \"quintic_spline\"; expected one of linear, gimp, cpgimp, cpdi, quadratic_spline, "
        "cubic_spline, did you mean \"quadratic_spline\"?");
  CHECK(problems_with({"/interpolator=linear"}) ==
        "--set#/interpolator: \"linear\" with the time step's rule \"viscous\"; expected the rule \"published\", as a "
        "particle that hardly reaches a node would have no stable step; or another interpolator");
  CHECK(problems_with({"/transfer=mpm"}) ==
        "--set#/transfer: \"mpm\"; expected one of flip, pic, blend, tflip, apic, tpic, xpic, fmpm, did you mean "
        "\"fmpm\"?");
  CHECK(problems_with({"/boundaries/x-=wall"}) ==
        "--set#/boundaries/x-: \"wall\"; expected one of symmetry, open, no_slip, periodic, {\"friction\": MU}");
  CHECK(problems_with({"/bodies/block/material=stel"}) ==
        "--set#/bodies/block/material: \"stel\"; expected steel, did you mean \"steel\"?");
}

TEST_CASE("patches that do not divide the grid are told with its cells")
{
  CHECK(problems_with({"/grid/patches=[1,3]"}) ==
        "--set#/grid/patches: 3 patches along y; expected a number that divides the 2 cells there");
}

TEST_CASE("patches too narrow for what their particles reach are told with their width")
{
  const std::string fine = "/grid/cell_size=0.25";

  CHECK(problems_with({fine, "/grid/patches=[2,1]"}) == "");
  CHECK(problems_with({fine, "/grid/patches=[2,4]"}) ==
        "--set#/grid/patches: 4 patches along y, 2 cells wide; expected patches at least 3 cells wide along an axis "
        "that is cut");
}

TEST_CASE("a domain that is no whole number of cells is told")
{
  CHECK(problems_with({"/grid/cell_size=0.3"}) ==
        "--set#/grid/cell_size: 6.666666667 cells along x; expected the grid's edges to be whole numbers of cells\n"
        "--set#/grid/cell_size: 6.666666667 cells along y; expected the grid's edges to be whole numbers of cells");
}

TEST_CASE("a domain without cells is told")
{
  CHECK_THAT(problems_with({"/grid/upper=[0,2]"}), Catch::Contains("#/grid/upper: 0 cells along x; expected 1 to"));
}

TEST_CASE("a geometry that leaves the grid is told with where it reaches")
{
  CHECK(problems_with({"/bodies/block/geometry/upper=[1,2.5]"}) ==
        "scene.json#/bodies/block/geometry: reaches from [0, 0] to [1, 2.5]; expected it to lie within the grid");
}

TEST_CASE("a geometry inside out is told")
{
  CHECK_THAT(problems_with({"/bodies/block/geometry/upper=[-1,1]"}),
             Catch::StartsWith("scene.json#/bodies/block/geometry: box from") && Catch::Contains("lower < upper"));
}

TEST_CASE("a body that holds no particle is told with the spacing of particles")
{
  CHECK(problems_with({"/bodies/block/geometry/upper=[0.1,0.1]"}) ==
        "scene.json#/bodies/block/geometry: holds no particle; expected a shape that holds a site of the particle "
        "lattice, whose spacing is 0.5 m");
}

TEST_CASE("bodies that overlap are told with where")
{
  const std::string geometry = R"({"type":"box","lower":[0.5,0.5],"upper":[2,2]})";

  CHECK(problems_with({"/bodies/second={\"material\":\"steel\",\"geometry\":" + geometry + "}"}) ==
        "--set#/bodies/second: overlaps body \"block\", at [0.75, 0.75]; expected bodies that share no particle");
}

TEST_CASE("bodies overlap too where only the finer particles of the first show it")
{
  const std::string fine =
      R"({"type":"hypoelastic","density":8000,"bulk_modulus":1e10,"shear_modulus":7e9,"particles_per_axis":4})";
  const std::string geometry = R"({"type":"box","lower":[0.8,0.8],"upper":[2,2]})";

  // The second body's only particle is at (1.5, 1.5).
  CHECK(problems_with({"/particles_per_cell=[1,1]", "/materials/fine=" + fine, "/bodies/block/material=fine",
                       "/bodies/second={\"material\":\"steel\",\"geometry\":" + geometry + "}"}) ==
        "--set#/bodies/second: overlaps body \"block\", at [0.875, 0.875]; expected bodies that share no particle");
}

TEST_CASE("a scene without bodies is told")
{
  CHECK(problems_with({"/bodies={}"}) == "--set#/bodies: an empty object; expected at least one entry");
}

TEST_CASE("a name that cannot be part of a file's columns is told")
{
  CHECK_THAT(problems_with({"/bodies/a.b={\"material\":\"steel\"}"}),
             Catch::Contains("#/bodies/a.b: a name with other characters; expected letters, digits, - and _ only"));
}

TEST_CASE("a material named as a word of the key normal is told")
{
  const std::string steel = R"({"type":"hypoelastic","density":8000,"bulk_modulus":1e10,"shear_modulus":7e9})";

  for (const std::string name : {"flatter", "regression"}) {
    CHECK(problems_with({"/materials/" + name + "=" + steel}) ==
          "--set#/materials/" + name + ": a word of the contact key normal; expected another name");
  }
  CHECK(problems_with({"/materials/flattest=" + steel}) == "");
}

TEST_CASE("contact of a material with itself, with an unknown one, or given twice is told")
{
  CHECK(problems_with({R"(/contact=[{"materials":["steel","steel"],"friction":0}])"}) ==
        "--set#/contact/0/materials: \"steel\" twice; expected two different materials");
  CHECK(problems_with({R"(/contact=[{"materials":["steel","snd"],"friction":0}])"}) ==
        "--set#/contact/0/materials: \"snd\"; expected 2 of steel");
  CHECK(problems_with_sand({R"(/contact=[{"materials":["steel","sand"],"friction":0},)"
                            R"({"materials":["sand","steel"],"friction":0}])"}) ==
        "--set#/contact/1/materials: a pair that is listed before; expected every pair once");
  CHECK(problems_with_sand({R"(/contact=[{"materials":["steel","sand"],"friction":-0.1}])"}) ==
        "--set#/contact/0/friction: -0.1; expected a number of 0 or above");
}

TEST_CASE("an assignment that cannot be made is told as it was given")
{
  CHECK(problems_with({"grid/cell_size=1"}) ==
        "--set grid/cell_size=1: not an assignment; expected /POINTER=VALUE, such as /grid/cell_size=0.01");
  CHECK(problems_with({"/grid"}) ==
        "--set /grid: not an assignment; expected /POINTER=VALUE, such as /grid/cell_size=0.01");
  CHECK(problems_with({"/dimension/x=1"}) ==
        "--set /dimension/x=1: there is no such place in the scene; expected a pointer to a key or to an item");
}

TEST_CASE("an assignment to a key that has no meaning is told")
{
  CHECK(problems_with({"/grid/cellsize=1"}) == "--set#/grid/cellsize: unknown key; did you mean \"cell_size\"?");
}

TEST_CASE("a problem in a material's file is told with that file, and one in the scene with the scene")
{
  CHECK(problems_with_sand({"/materials/sand/density=0"}) ==
        "--set#/materials/sand/density: 0; expected a number above 0 [kg/m^3]");
  CHECK(problems_with_sand({"/materials/sand/poisson_ratio=null"}) ==
        "--set#/materials/sand/poisson_ratio: missing; expected a number above -1 and below 0.5");
  const TemporaryFolder folder;
  write_sand(folder);
  folder.write("sand.json", R"({"type":"tabular_cap","poisson_ratio":0.7})");
  std::string scene = small_scene;
  scene.replace(scene.find("\"steel\": {"), 0, R"("sand": { "file": "../sand.json", "density": -1 }, )");
  const std::string problems = problems_of(folder, folder.write("scenes/scene.json", scene));
  CHECK_THAT(problems, Catch::Contains("scenes/scene.json#/materials/sand/density: -1; expected"));
  CHECK_THAT(problems, Catch::Contains("\nsand.json#/poisson_ratio: 0.7; expected a number above -1 and below 0.5"));
  CHECK_THAT(problems, Catch::Contains("\nsand.json#/modulus: missing; expected an object"));
}

TEST_CASE("a missing file is told with the path that was tried")
{
  CHECK(problems_with_sand({"/materials/sand/file=nothing.json"}) ==
        "--set#/materials/sand/file: there is no file nothing.json; expected the path of a JSON file\n"
        "scenes/scene.json#/materials/sand/type: missing; expected one of hypoelastic, neo_hookean, neo_hookean_log, "
        "drucker_prager, tabular_cap");
  CHECK(problems_with_sand({"/materials/sand/crush_curve=no.csv"}) ==
        "--set#/materials/sand/crush_curve: there is no file no.csv; expected the path of a file");
}

TEST_CASE("a table with other columns is told with those that were expected")
{
  CHECK(problems_with_table("crush_curve.csv", "strain,pressure[Pa]\n0,1\n") ==
        "tables/crush_curve.csv:1: columns strain,pressure[Pa]; expected plastic_volumetric[-],pressure[Pa]");
}

TEST_CASE("rows of a table that are no numbers are told with file and line")
{
  CHECK(
      problems_with_table("crush_curve.csv", "# c\nplastic_volumetric[-],pressure[Pa]\n0,1e6\n0.1\n0.2,nan\nx,1e7\n") ==
      "tables/crush_curve.csv:4: 1 values; expected 2\n"
      "tables/crush_curve.csv:5: \"nan\" for pressure[Pa]; expected a finite number\n"
      "tables/crush_curve.csv:6: \"x\" for plastic_volumetric[-]; expected a finite number");
}

TEST_CASE("an empty table is told")
{
  CHECK(problems_with_table("crush_curve.csv", "# nothing\n") ==
        "tables/crush_curve.csv:1: no line with the names of the columns; expected plastic_volumetric[-],pressure[Pa]");
  CHECK(problems_with_table("crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n") ==
        "tables/crush_curve.csv:1: a table without rows; expected numbers");
}

TEST_CASE("a table whose numbers make no curve is told with file and line")
{
  CHECK_THAT(problems_with_table("crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n0,1e6\n\n0.2,2e7\n0.1,3e7\n"),
             Catch::StartsWith("tables/crush_curve.csv:5: "));
  CHECK_THAT(problems_with_table("crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n0,1e6\n0.1,2e7\n0.2,1e7\n"),
             Catch::StartsWith("tables/crush_curve.csv:4: crush pressure"));
  CHECK_THAT(problems_with_table("yield.csv", "pressure[Pa],sqrt_J2[Pa]\n-1e4,5\n1e6,6e5\n"),
             Catch::StartsWith("tables/yield.csv:2: "));
  CHECK_THAT(problems_with_table("unloading.csv",
                                 "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n"
                                 "0.05,0,0\n0.05,0.005,5e6\n0.05,0.01,1e7\n0.04,0,0\n"),
             Catch::StartsWith("tables/unloading.csv:5: "));
}

TEST_CASE("more materials or bodies than a step has room for are refused")
{
  std::vector<std::string> bodies;
  for (int i = 0; i < 17; ++i) {
    bodies.push_back("/bodies/b" + std::to_string(i) +
                     R"(={"material": "steel", "geometry": {"type": "box", "lower": [0, 1], "upper": [1, 2]}})");
  }
  CHECK(problems_with(bodies) == "scene.json#/bodies: 18 entries; expected at most 16");
}

}  // namespace test_bad_scenes
