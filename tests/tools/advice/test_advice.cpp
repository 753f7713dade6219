#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/program.hpp"

/// Advice of `tamp check` on shipped scenes. Steps and times are those of trial runs, which differ between machines.
namespace test_advice
{

using namespace tamp::test;

namespace
{

std::string check_of(const std::string& scene, const std::string& more = "")
{
  const Outcome outcome = tamp_with("check " TAMP_SOURCE_DIR "/inputs/" + scene + " " + more);
  REQUIRE(outcome.exit_code == 0);
  return outcome.out;
}

}  // namespace

TEST_CASE("the check of the quick punch says what a rigid punch, finer cells and a smaller box would do")
{
  const std::string said = check_of("punch/quick.json");

  CHECK_THAT(said, Catch::Contains("advice  step: sand sets it (waves of 1573 m/s in punch, 909 in sand); rigid, punch "
                                   "would take about "));
  CHECK_THAT(said, Catch::Contains("its depth is some 2.5 % off a deformable one's"));
  CHECK_THAT(said,
             Catch::Contains("advice  cells: punch has 6.0 to its half width, and needs no more than 6; "
                             "the force on it is 8 % too large (tamp study inputs/studies/penetration_punch.json)\n"));
  CHECK_THAT(said,
             Catch::Contains("advice  box: waves in sand (909 m/s) reach its side x- after 0.38 ms and are back at "
                             "punch after 0.77 ms, of 7 ms\n"));
  CHECK_THAT(said, !Catch::Contains("method:") && !Catch::Contains("rule:") && !Catch::Contains("slab:"));
}

TEST_CASE("for a short time a smaller box and a rigid punch would do")
{
  const std::string said = check_of("punch/quick.json", "--set /time/end=1e-4");

  CHECK_THAT(said, Catch::Contains("its depth is only some 0.72 % off a deformable one's"));
  CHECK_THAT(said, Catch::Contains("box: waves in sand (909 m/s) travel 0.091 m in 0.1 ms and do not return to punch "
                                   "from any side; 0.36 of the cells are enough, with /grid/lower=[0.2,0.325] "
                                   "/grid/upper=[0.8,0.8] /grid/patches=[2,1] /bodies/sand/geometry/lower=[0.2,0.325] "
                                   "/bodies/sand/geometry/upper=[0.8,0.5]\n"));
}

TEST_CASE("of a punch that is faster than waves it is said when it is at a side itself, not when they are back")
{
  CHECK_THAT(check_of("punch/quick.json", "--set /bodies/punch/velocity=[0,-1500]"),
             Catch::Contains("box: waves in sand (909 m/s) are outrun by punch, which is at its side y- after 0.33 ms, "
                             "of 7 ms\n"));
}

TEST_CASE("a punch of real steel bounds the step, and one of rubber is too soft to be rigid", "[slow]")
{
  const std::string steel = "--set /materials/steel/bulk_modulus=160e9 --set /materials/steel/shear_modulus=80e9";
  const std::string rubber = "--set /materials/steel/bulk_modulus=1e9 --set /materials/steel/shear_modulus=1e7";

  CHECK_THAT(check_of("punch/quick.json", steel), Catch::Contains("step: punch sets it (waves of 5774 m/s in punch, "));
  CHECK_THAT(check_of("punch/quick.json", rubber),
             Catch::Contains("more than 1 % off a deformable one's, as it is strained by 19 %"));
}

TEST_CASE("the slab and the report's settings are told what costs less", "[slow]")
{
  CHECK_THAT(check_of("punch/slab.json"), Catch::Contains("advice  slab: one cell between smooth walls"));
  CHECK_THAT(
      check_of("punch/table.json"),
      Catch::Contains("advice  method: \"gimp\", \"flip\", viscosity 0.2 / 2 is off the front of cost and error: "
                      "the force on a piston at 200 m/s is 5.9 % off (tamp verify piston_200); with ") &&
          Catch::Contains("advice  rule: \"published\" times 0.05 takes short steps; \"viscous\" times 1 would "
                          "take about "));
  CHECK_THAT(check_of("punch/quick.json", "--set /transfer=tflip"), !Catch::Contains("method:"));
  CHECK_THAT(check_of("punch/quick.json", "--set /transfer=pic"),
             Catch::Contains(
                 "advice  method: the error of \"cubic_spline\", \"pic\", viscosity 1 / 4 in the force on a piston at "
                 "200 m/s is not known for this scene (`tamp check SCENE --study OUT.json` writes"));
}

TEST_CASE("the check of the projectile says that it is thin, that it sets the step if deformable, and what turns it",
          "[slow]")
{
  const std::string rigid = check_of("uxo/quick.json"), deformable = check_of("uxo/table.json");

  CHECK_THAT(rigid, Catch::Contains("advice  step: sand sets it, projectile is rigid (waves of 5489 m/s in projectile, "
                                    "731 in sand); its depth is some 14 % off a deformable one's\n"));
  CHECK_THAT(deformable, Catch::Contains("advice  step: projectile sets it "));
  CHECK_THAT(rigid, Catch::Contains("advice  cells: projectile has 1.2 to its half width, and needs 6; by how much the "
                                    "force on it is too large is not known for this scene (`tamp check SCENE --study "
                                    "OUT.json` writes the study that tells); cells of 0.00096 m cost 740 times as "
                                    "much\n"));
  CHECK_THAT(rigid, Catch::Contains("advice  method: \"gimp\", \"flip\", viscosity 1 / 4 is off the front of cost and "
                                    "error: the turn of a thin body is 35 % off"));
  CHECK_THAT(check_of("uxo/fine.json"), !Catch::Contains("method:"));
}

TEST_CASE("whoever meets a rigid body by its particles is told of its solid", "[slow]")
{
  CHECK_THAT(check_of("uxo/quick.json", "--set /contact/0/normal=regression"),
             Catch::Contains("advice  contact: with \"normal\": \"solid\" sand would touch "
                             "the solid of projectile instead of its particles"));
  CHECK_THAT(check_of("uxo/quick.json"), !Catch::Contains("contact:"));
}

TEST_CASE("soil that is pressed is told of anti-locking, and not of bodies that go into it")
{
  // As it was verified, without local damping.
  const std::string said = check_of("footing/quick.json", "--set /local_damping=0");

  CHECK_THAT(said, Catch::Contains("advice  method: \"gimp\", \"flip\", no viscosity is off the front"));
  CHECK_THAT(said, Catch::Contains("the load of a strip footing 20 cells wide is 19 % off (tamp verify footing)"));
  CHECK_THAT(check_of("footing/quick.json"), Catch::Contains("with \"quadratic_spline\" and anti_locking"));
  CHECK_THAT(said, !Catch::Contains("step:") && !Catch::Contains("box:"));
}

TEST_CASE("what nobody has measured of a scene is said to be not known, and no other scene's number is given for it",
          "[slow]")
{
  const std::string not_known = "is not known for this scene (`tamp check SCENE --study OUT.json` writes the study";
  const auto cells_line = [](const std::string& said) {
    const std::size_t begin = said.find("cells: ");
    return said.substr(begin, said.find('\n', begin) - begin);
  };

  for (const char* other : {"/interpolator=quadratic_spline", "/transfer=apic", "/artificial_viscosity/linear=0.9",
                            "/particles_per_cell=[3,3]", "/bodies/punch/velocity=[0,-10]", "/stress_timing=musl"}) {
    const std::string said = check_of("punch/quick.json", "--set '" + std::string(other) + "'");
    CAPTURE(other, said);
    CHECK_THAT(cells_line(said), Catch::Contains(not_known));
  }
  CHECK_THAT(cells_line(check_of("savings/ball.json")), Catch::Contains(not_known));
  CHECK_THAT(cells_line(check_of("punch/quick.json", "--set /grid/cell_size=0.03125 --set /grid/upper=[1,0.8125]")),
             Catch::Contains("the force on it is 8 to 16 % too large (tamp study "));
  CHECK_THAT(check_of("punch/quick.json", "--set /interpolator=quadratic_spline"),
             Catch::Contains("method: the error of \"quadratic_spline\"") && Catch::Contains(not_known));
}

TEST_CASE("the check writes the study that tells how far a scene is off, and it runs as it is", "[slow]")
{
  const TemporaryFolder folder;
  const std::string study = (folder.path() / "tells.json").string(), out = (folder.path() / "out").string();
  const std::string scene = "check " TAMP_SOURCE_DIR "/inputs/savings/ball.json ";
  const std::string set = "--set /time/end=1e-5 --set /output/history_interval=1e-6 ";

  const Outcome checked = tamp_with(scene + set + "--study " + study);
  const Outcome ran = tamp_with("study " + study + " --quiet --out " + out);

  INFO(checked.out << checked.err << ran.err);
  REQUIRE(checked.exit_code == 0);
  REQUIRE(ran.exit_code == 0);
  const auto results = nlohmann::json::parse(read_text(folder.path() / "out" / "study.json"));
  // Two methods on three grids, and as many runs that they are compared with.
  CHECK(results["points"].size() == 12);
  for (const auto& point : results["points"]) {
    CHECK(point["ended"] == "done");
    CHECK(point["values"]["depth of ball"].get<double>() > 0);
    CHECK(point["errors"]["depth of ball"].get<double>() < 0.1);
  }
}

TEST_CASE("a study that would replace the scene, or has nothing to ask, is refused and nothing is written")
{
  const TemporaryFolder folder;
  const std::string still = R"({
    "dimension": 2, "grid": { "upper": [1, 1], "cell_size": 0.25 }, "time": { "end": 1e-3 },
    "materials": { "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e9, "shear_modulus": 7e8 } },
    "bodies": { "block": { "material": "steel", "geometry": { "type": "box", "lower": [0, 0], "upper": [1, 0.5] } } }
  })";
  const auto scene = folder.write("still.json", still);

  const Outcome over_itself = tamp_with("check " + scene.string() + " --study " + scene.string());
  const Outcome nothing = tamp_with("check " + scene.string() + " --study " + (folder.path() / "s.json").string());

  CHECK(over_itself.exit_code == 2);
  CHECK(read_text(scene) == still);
  CHECK(nothing.exit_code == 2);
  CHECK_THAT(nothing.err, Catch::Contains("no body of the scene moves"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "s.json"));
}

}  // namespace test_advice
