#include <catch2/catch.hpp>
#include <string>

#include "tests/tools/program.hpp"

/// What `tamp check` advises on shipped scenes. Steps and times are those of trial runs, which tell two machines apart.
namespace test_advice
{

using namespace tamp::test;

namespace
{

std::string check_of(const std::string& scene, const std::string& more = "")
{
  const Outcome outcome = tamp_with("check " TAMP_SOURCE_DIR "/inputs/" + scene + " " + more);
  REQUIRE(outcome.exit_code == 0);
  return outcome.err;
}

}  // namespace

TEST_CASE("the check of the quick punch says what a rigid punch, finer cells and a smaller box would do")
{
  const std::string said = check_of("punch/quick.json");

  CHECK_THAT(said, Catch::Contains("advice  step: sand sets it (waves of 1573 m/s in punch, 909 in sand); rigid, punch "
                                   "would take about "));
  CHECK_THAT(said, Catch::Contains("its depth is not within 1 % of a deformable one's, some 2.5 % off"));
  CHECK_THAT(said, Catch::Contains("advice  cells: punch has 6.0 to its half width, and needs 6; the force on it "
                                   "is some 12 % too large\n"));
  CHECK_THAT(said, Catch::Contains("advice  box: waves in sand (909 m/s) are at its side x- after 0.38 ms and back at "
                                   "punch after 0.77 ms, of 7 ms\n"));
  CHECK_THAT(said, !Catch::Contains("method:") && !Catch::Contains("rule:") && !Catch::Contains("slab:"));
}

TEST_CASE("for a short time a smaller box and a rigid punch would do")
{
  const std::string said = check_of("punch/quick.json", "--set /time/end=1e-4");

  CHECK_THAT(said, Catch::Contains("its depth is within 1 % of a deformable one's, some 0.72 % off"));
  CHECK_THAT(said, Catch::Contains("box: waves in sand (909 m/s) come 0.091 m far in 0.1 ms and are not back at punch "
                                   "from any side; 0.36 of the cells would do, with /grid/lower=[0.2,0.325] "
                                   "/grid/upper=[0.8,0.8] /grid/patches=[2,1] /bodies/sand/geometry/lower=[0.2,0.325] "
                                   "/bodies/sand/geometry/upper=[0.8,0.5]\n"));
}

TEST_CASE("of a punch that is faster than waves it is said when it is at a side itself, not when they are back")
{
  CHECK_THAT(check_of("punch/quick.json", "--set /bodies/punch/velocity=[0,-1500]"),
             Catch::Contains("box: waves in sand (909 m/s) are outrun by punch, which is at its side y- after 0.33 ms, "
                             "of 7 ms\n"));
}

TEST_CASE("a punch of real steel bounds the step, and one of rubber is too soft to be rigid")
{
  const std::string steel = "--set /materials/steel/bulk_modulus=160e9 --set /materials/steel/shear_modulus=80e9";
  const std::string rubber = "--set /materials/steel/bulk_modulus=1e9 --set /materials/steel/shear_modulus=1e7";

  CHECK_THAT(check_of("punch/quick.json", steel), Catch::Contains("step: punch sets it (waves of 5774 m/s in punch, "));
  CHECK_THAT(check_of("punch/quick.json", rubber),
             Catch::Contains("more than 1 % off a deformable one's, as it is strained by 19 %"));
}

TEST_CASE("the slab and the report's settings are told what costs less")
{
  CHECK_THAT(check_of("punch/slab.json"), Catch::Contains("advice  slab: one cell between smooth walls"));
  CHECK_THAT(
      check_of("punch/table.json"),
      Catch::Contains("advice  method: \"gimp\", \"flip\", viscosity 0.2 / 2 is off the front of cost and error: "
                      "the force on a piston at 200 m/s is 3 to 8 % off;") &&
          Catch::Contains("advice  rule: \"published\" times 0.05 takes short steps; \"viscous\" times 1 would "
                          "take about "));
  CHECK_THAT(check_of("punch/quick.json", "--set /transfer=tflip"), !Catch::Contains("method:"));
  CHECK_THAT(check_of("punch/quick.json", "--set /transfer=pic"),
             Catch::Contains("advice  method: \"cubic_spline\", \"pic\", viscosity 1 / 4 is off the front"));
}

TEST_CASE("the check of the projectile says that it is thin, that it sets the step if deformable, and what turns it")
{
  const std::string rigid = check_of("uxo/quick.json"), deformable = check_of("uxo/table.json");

  CHECK_THAT(rigid,
             Catch::Contains("advice  step: sand sets it, projectile is rigid (waves of 5489 m/s in projectile, "
                             "731 in sand); its depth is not within 1 % of a deformable one's, some 14 % off\n"));
  CHECK_THAT(deformable, Catch::Contains("advice  step: projectile sets it "));
  CHECK_THAT(rigid, Catch::Contains("advice  cells: projectile has 1.2 to its half width, and needs 6; the force "
                                    "on it is some 310 % too large; cells of 0.00096 m cost 740 times as much\n"));
  CHECK_THAT(rigid, Catch::Contains("advice  method: \"gimp\", \"flip\", viscosity 1 / 4 is off the front"));
  CHECK_THAT(check_of("uxo/fine.json"), !Catch::Contains("method:"));
}

TEST_CASE("soil that is pressed is told of anti-locking, and not of bodies that go into it")
{
  const std::string said = check_of("footing/quick.json");

  CHECK_THAT(said, Catch::Contains("advice  method: \"gimp\", \"flip\", no viscosity is off the front"));
  CHECK_THAT(said, !Catch::Contains("step:") && !Catch::Contains("box:"));
}

}  // namespace test_advice
