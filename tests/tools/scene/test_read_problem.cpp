#include <catch2/catch.hpp>

#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/json/print_json.hpp"

namespace test_read_problem
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// The small scene, its block soft and with a problem, after some more assignments.
std::vector<std::string> with_problem(const std::string& problem, const std::vector<std::string>& more = {})
{
  std::vector<std::string> assignments{
      R"(/materials/steel={"type":"neo_hookean","density":1,"bulk_modulus":8333,"shear_modulus":3846})",
      "/bodies/block/problem=" + problem};
  assignments.insert(assignments.end(), more.begin(), more.end());
  return assignments;
}

std::string problems_of_problem(const std::string& problem, const std::vector<std::string>& more = {})
{
  return problems_with(with_problem(problem, more));
}

const std::string aligned = R"({"type":"axis_aligned","amplitude":0.05,"length":1,"n_axes":2})";
const std::string disk =
    R"({"type":"rotating_disk","centre":[1,1],"outer_radius":0.9,"inner_radius":0.4,"angular_speed":5})";
const std::string ring_of_disk =
    R"(/bodies/block/geometry={"type":"difference","of":[{"type":"ball","centre":[1,1],"radius":0.9},)"
    R"({"type":"ball","centre":[1,1],"radius":0.4}]})";

const std::string log_solid =
    R"(/materials/steel={"type":"neo_hookean_log","density":1,"bulk_modulus":400,"shear_modulus":600})";
const std::string ring_of =
    R"({"type":"ring","centre":[1,1],"outer_radius":0.9,"inner_radius":0.4,"amplitude":0.05,"on_rings":)";

const std::string at_problem = "--set#/bodies/block/problem";

}  // namespace

TEST_CASE("a body's problem gives its functions, with what the scene leaves out")
{
  const TemporaryFolder folder;
  const auto checked = tools::read_scene(folder.write("small.json", small_scene), with_problem(aligned));

  const components::BodyFunctions& functions = checked.scene.bodies.at(0).functions;
  REQUIRE(functions.body_force);
  CHECK(functions.displacement({0.5, 0.5, 0})[1] == Approx(0.05 * std::sqrt(0.75)));
  CHECK(checked.resolved["bodies"]["block"]["problem"]["origin"] == tools::Json({0, 0}));
  CHECK(tools::read_scene(folder.write("again.json", tools::printed(checked.resolved))).resolved["bodies"] ==
        checked.resolved["bodies"]);
}

TEST_CASE("a body whose problem lays out its particles has those")
{
  const TemporaryFolder folder;
  const auto scene =
      tools::read_scene(folder.write("small.json", small_scene), with_problem(disk, {ring_of_disk})).scene;

  // A single ring in the half metre between the radii, 0.65 from the centre: 8.2 particles of half a metre.
  CHECK(scene.bodies.at(0).n_particles == 8);
}

TEST_CASE("a body whose problem may lay out its particles has those of the lattice where it is asked not to")
{
  const TemporaryFolder folder;
  const std::string path = folder.write("small.json", small_scene);
  const auto of_flag = [&](const std::string& flag) {
    return tools::read_scene(path, with_problem(ring_of + flag + "}", {log_solid, ring_of_disk}));
  };

  // Sites are at 0.25, 0.75, 1.25 and 1.75 along both axes. The corners, 1.06 from the centre, and the four in the
  // middle, 0.354 from it, lie outside of the ring.
  CHECK(of_flag("false").scene.bodies.at(0).n_particles == 8);
  CHECK(!of_flag("false").scene.bodies.at(0).functions.layout);
  CHECK(of_flag("true").scene.bodies.at(0).functions.layout);
  CHECK(of_flag("false").resolved["bodies"]["block"]["problem"]["on_rings"] == false);
  CHECK(problems_of_problem(ring_of + "1}", {log_solid, ring_of_disk}) ==
        at_problem + "/on_rings: 1; expected true or false");
}

TEST_CASE("a problem that is not known, or lacks something, is reported")
{
  CHECK(problems_of_problem(R"({"type":"axis_alined"})") ==
        at_problem + R"(/type: "axis_alined"; expected one of axis_aligned, cavity, compacted_column, ring, )"
                     R"(rotating_disk, vibrating_bar, vortex, did you mean "axis_aligned"?)");
  CHECK(problems_of_problem(R"({"type":"vibrating_bar","speed":1})") ==
        at_problem + "/wave_number: missing; expected a number above 0 [rad/m]");
  CHECK(problems_of_problem(R"({"type":"vibrating_bar","speed":1,"wave_number":-1})") ==
        at_problem + "/wave_number: -1; expected a number above 0 [rad/m]");
  CHECK(problems_of_problem(R"({"type":"vibrating_bar","speed":1,"wave_number":1,"lenght":2})") ==
        at_problem + "/lenght: unknown key; expected one of drift, speed, type, wave_number");
  CHECK(problems_of_problem(R"({"type":"axis_aligned","amplitude":0.05,"length":1,"n_axes":1.5})") ==
        at_problem + "/n_axes: 1.5; expected a whole number from 1 to 3");
  CHECK(problems_of_problem("3") == at_problem + ": 3; expected an object");
}

TEST_CASE("a problem whose parameters do not go together is reported")
{
  CHECK(problems_of_problem(R"({"type":"axis_aligned","amplitude":0.05,"length":1,"n_axes":3})") ==
        at_problem + "/n_axes: 3; expected at most the scene's dimension, 2");
  CHECK(problems_of_problem(R"({"type":"axis_aligned","amplitude":0.4,"length":1,"n_axes":2})") ==
        at_problem + "/amplitude: 0.4; expected less than length / pi, as more turns the body inside out");
}

TEST_CASE("a problem that does not go with its body or its scene is reported")
{
  const std::string steel =
      R"(/materials/steel={"type":"hypoelastic","density":8000,"bulk_modulus":10e9,"shear_modulus":7e9})";
  CHECK(problems_of_problem(aligned, {steel}) ==
        at_problem + ": another material; expected one of type neo_hookean or neo_hookean_log, for which it is made");
  CHECK(problems_of_problem(aligned, {"/bodies/block/rigid=true"}) ==
        at_problem + ": a rigid body's; expected that of a body that is not rigid");
  CHECK(problems_of_problem(aligned, {"/bodies/block/velocity=[1,0]"}) ==
        at_problem + ": that of a body with a velocity; expected the velocity of the problem alone");
  CHECK(problems_of_problem(aligned, {"/bodies/block/angular_velocity=[1]"}) ==
        at_problem + ": that of a body with a velocity; expected the velocity of the problem alone");
  CHECK(problems_of_problem(aligned, {"/gravity=[0,-9.81]"}) ==
        at_problem +
            ": an exact solution in a scene with gravity or a centrifuge; expected the problem's own loads "
            "alone");
  CHECK_THAT(
      problems_of_problem(aligned, {"/bodies/block/initial_stress=true"}),
      Catch::Contains(at_problem + ": that of a body that starts settled; expected either it or initial_stress"));
  CHECK(problems_of_problem(disk, {"/dimension=3", "/grid/upper=[2,2,2]",
                                   R"(/bodies/block/geometry={"type":"box","lower":[0,0,0],"upper":[1,1,1]})",
                                   "/bodies/block/problem/centre=[1,1,1]"}) ==
        at_problem + ": a scene of dimension 3; expected one of dimension 2, in which it is a disk");
}

TEST_CASE("a ring whose rims would not be free is reported")
{
  CHECK(problems_of_problem(ring_of + "true}", {log_solid, ring_of_disk, "/materials/steel/bulk_modulus=500"}) ==
        at_problem +
            ": a material of bulk modulus 500; expected 2/3 of its shear modulus, 400, with which its rims are "
            "free");
  CHECK(problems_of_problem(ring_of + "true}", {log_solid, ring_of_disk, "/materials/steel/bulk_modulus=300"}) ==
        "--set#/materials/steel/bulk_modulus: 300; expected at least 2/3 of the shear modulus, 400");
}

TEST_CASE("particles of a lattice where a problem does not hold are reported")
{
  CHECK(problems_of_problem(ring_of + "false}", {log_solid}) ==
        "scene.json#/bodies/block/geometry: a particle at [0.25, 0.25]; expected all of them where the problem is "
        "set");
}

TEST_CASE("particles that a problem puts outside of the body or the grid are reported")
{
  // A ring of 0.65 m about (1, 1), its first particle an eighth of pi from the x axis.
  CHECK_THAT(problems_of_problem(disk), Catch::StartsWith(at_problem + ": a particle at [1.60052") &&
                                            Catch::Contains("expected all of them within the body's geometry"));
  // At y = 0.25 the second axis starts 0.3 sqrt(3)/2 below it, which is below the wall.
  CHECK_THAT(problems_of_problem(R"({"type":"axis_aligned","amplitude":0.3,"length":1,"n_axes":2,"origin":[0,0.75]})"),
             Catch::StartsWith(at_problem + ": the particle of [0.25, 0.25] starts at [0.25, -0.0098") &&
                 Catch::Contains("expected a place within the grid"));
}

}  // namespace test_read_problem
