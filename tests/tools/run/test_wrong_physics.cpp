#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/tools/run/run_with.hpp"

namespace test_wrong_physics
{

/// A run that ends in nonsense does not say "completed".
using namespace tamp::test;

namespace
{

const std::string punch = TAMP_SOURCE_DIR "/inputs/punch/quick.json";
const std::string quiet_punch = punch + " --quiet ";

bool warns(const std::string& assignment, const std::string& words)
{
  const Outcome outcome = tamp_with("check --no-trial " + punch + " --set " + assignment);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  return outcome.out.find("tamp: warning: ") != std::string::npos && outcome.out.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a run whose energy is wrong by more than its limit ends with 3, with its state kept")
{
  const std::string bound = " --set /limits/energy_error=1e-5";
  const Run wrong = run_with(quiet_punch + "--steps 100" + bound),
            off = run_with(quiet_punch + "--steps 20 --set /limits/energy_error=off");

  CHECK(wrong.outcome.exit_code == 3);
  CHECK_THAT(wrong.outcome.err, Catch::Contains("the energy is wrong by") && Catch::Contains("/limits/energy_error"));
  CHECK(wrong.summary["status"] == "unstable");
  CHECK(off.outcome.exit_code == 0);
}

TEST_CASE(
    "the energy of every step is judged, also between the rows of the history, and the summary has what was judged")
{
  const Run wrong =
      run_with(quiet_punch + "--steps 100 --set /limits/energy_error=1e-5 --set /output/history_interval=1");

  CHECK(wrong.outcome.exit_code == 3);
  CHECK(wrong.summary["status"] == "unstable");
  CHECK(wrong.summary["energy_error"].get<double>() > 1e-5);
  CHECK_THAT(wrong.outcome.err,
             Catch::Contains(fmt::format("{:.3g} times the", wrong.summary["energy_error"].get<double>())));
}

TEST_CASE("a comparison judges the energy of every step too", "[slow]")
{
  const TemporaryFolder folder;

  const Outcome outcome = tamp_with("compare " + punch + " --models table --steps 40 --quiet --out " +
                                    (folder.path() / "compare").string() +
                                    " --set /limits/energy_error=1e-6 --set /output/history_interval=1");

  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.err, Catch::Contains("the energy is wrong by"));
}

TEST_CASE("a run from rest is not ended in its first steps by an error that is nothing of what it is given")
{
  // Widened from rest, it is given 4 J in two steps and 188 kJ in the end.
  const Run slow = run_with(TAMP_SOURCE_DIR
                            "/inputs/verification/scenes/cavity.json --quiet "
                            "--set /limits/energy_error=0.02");
  const Run unstable = run_with(TAMP_SOURCE_DIR
                                "/inputs/stability/scenes/grain.json --quiet "
                                "--set /limits/energy_error=0.2");

  INFO(slow.outcome.err << unstable.outcome.err);
  CHECK(slow.outcome.exit_code == 0);
  CHECK(slow.summary["energy_error"].get<double>() < 0.002);
  CHECK(unstable.outcome.exit_code == 3);
  CHECK_THAT(unstable.outcome.err, Catch::Contains("the energy is wrong by"));
}

TEST_CASE("free fall from rest, whose first velocities are half a step late, has its energy right")
{
  const TemporaryFolder folder;
  const auto scene = folder.write("fall.json", R"({
    "dimension": 2, "grid": { "upper": [2, 2], "cell_size": 0.25 }, "time": { "end": 0.01 }, "gravity": [0, -9.81],
    "materials": { "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e7, "shear_modulus": 7e6 } },
    "bodies": {
      "block": { "material": "steel", "geometry": { "type": "box", "lower": [0.5, 1], "upper": [1, 1.5] } }
    },
    "output": { "history_interval": 1e-6 }
  })");

  const Outcome outcome = tamp_with("run " + scene.string() + " --quiet --out " + (folder.path() / "run").string());

  CHECK(outcome.exit_code == 0);
}

TEST_CASE("what is hardly ever meant is warned of", "[slow]")
{
  const TemporaryFolder folder;
  const auto mega = folder.write("yield.csv", "pressure[Pa],sqrt_J2[Pa]\n-0.001,0\n100,50\n");

  CHECK(warns("/materials/sand/density=1e-320", "no known matter"));
  CHECK(warns("/contact/0/normal=flatter", "/contact/0/normal: with \"flatter\" and splines"));
  CHECK(warns("/gravity=[0,-1e6]", "/gravity: "));
  CHECK(warns("/time/multiplier=1.5", "/time/multiplier: steps of 1.5 times the bound"));
  CHECK(warns("/bodies/punch/velocity=[0,-20000]", "faster than the fastest wave"));
  CHECK(
      warns("'/materials/extra={\"type\":\"hypoelastic\",\"density\":7800,\"bulk_modulus\":1e9,\"shear_modulus\":1e9}'",
            "/materials/extra: no body is of this material"));
  CHECK(warns("/materials/sand/yield/file=" + mega.string(), "look like MPa"));
  CHECK(warns("'/bodies/punch/geometry={\"type\":\"ball\",\"centre\":[0.5,0.6],\"radius\":0.0401}'", "of its mass"));
  const std::string as_tested = "/materials/sand/density=1624 --set /materials/sand/strain_measure=engineering";
  CHECK_FALSE(warns(as_tested, ""));
}

TEST_CASE("the check says on how many cells a body goes into another one, and the run warns where they are few",
          "[slow]")
{
  const Outcome as_shipped = tamp_with("check --no-trial " + punch);
  const Run coarse = run_with(quiet_punch + "--steps 1 --set /grid/cell_size=0.05");

  CHECK_THAT(as_shipped.out, Catch::Contains("6.0 cells across its half width, going into sand"));
  CHECK_FALSE(warns("/grid/cell_size=0.025", "half its width"));
  REQUIRE(coarse.summary["warnings"].size() == 1);
  CHECK_THAT(coarse.summary["warnings"][0].get<std::string>(), Catch::Contains("half its width is only 3 cells"));
}

TEST_CASE("a run whose substeps miss their tolerance ends with a warning that says how many do", "[slow]")
{
  const std::string rough = "--steps 200 --set /materials/sand/tolerance=1e-9 --set /materials/sand/max_substeps=1";

  const Run warned = run_with(quiet_punch + rough),
            allowed = run_with(quiet_punch + rough + " --set /limits/missed_substeps=1");

  CHECK(warned.summary["status"] == "completed with warnings");
  CHECK_THAT(warned.outcome.err, Catch::Contains("substeps of the materials missed their tolerance") &&
                                     Catch::Contains("more than /limits/missed_substeps, 5 %"));
  CHECK(allowed.summary["status"] == "completed");
}

TEST_CASE("soil in kPa, radians and t/m3 is warned of, number by number")
{
  const TemporaryFolder folder;
  const auto scene = folder.write("soil.json", R"({
    "dimension": 2, "grid": { "upper": [1, 1], "cell_size": 0.125 }, "time": { "end": 0.01 }, "gravity": [0, -9.81],
    "boundaries": { "y+": "open" },
    "materials": { "soil": { "type": "drucker_prager", "density": 1420, "bulk_modulus": 42e6, "shear_modulus": 19e6,
                             "friction_angle": 30, "dilation_angle": 0.17, "cohesion": 5 } },
    "bodies": { "soil": { "material": "soil", "geometry": { "type": "box", "lower": [0, 0], "upper": [1, 0.5] } } }
  })");
  const auto checked = [&](const std::string& assignments) {
    return tamp_with("check --no-trial " + scene.string() + assignments).out;
  };
  const std::string right = checked("");
  const std::string wrong = checked(
      " --set /materials/soil/density=1.42 --set /materials/soil/bulk_modulus=42e3 --set "
      "/materials/soil/shear_modulus=19e3"
      " --set /materials/soil/friction_angle=0.52");
  const std::string pressed = checked(" --set '/bodies/soil/pressure={\"value\":1e9}'");

  CHECK_THAT(right, !Catch::Contains("warning"));
  CHECK_THAT(wrong, Catch::Contains("/materials/soil/density: 1.42 kg/m3 looks like t/m3"));
  CHECK_THAT(wrong, Catch::Contains("/materials/soil/bulk_modulus: 4.2e+04 Pa looks like kPa or MPa"));
  CHECK_THAT(wrong, Catch::Contains("/materials/soil/shear_modulus: 1.9e+04 Pa looks like kPa or MPa"));
  CHECK_THAT(wrong, Catch::Contains("/materials/soil/friction_angle: 0.52 degrees looks like radians"));
  CHECK_THAT(pressed,
             Catch::Contains("/bodies/soil/pressure: 1e+09 Pa from the start is 15 times the stiffness of soil"));
}

TEST_CASE("the check warns of contact ahead of touch, and of tips that hold no particle", "[slow]")
{
  const auto checked = [](const std::string& assignments) {
    return tamp_with("check --no-trial " TAMP_SOURCE_DIR "/inputs/cone/quick.json" + assignments).out;
  };
  const std::string own = checked(" --set /contact/0/normal=steel"), as_shipped = checked(""),
                    blunt = checked(
                        " --set /contact/0/normal=regression --set /bodies/cone/geometry/of/1/of/0/first_radius=0.015"
                        " --set /grid/cell_size=0.0025");

  CHECK_THAT(own, Catch::Contains("/contact/0/normal: bodies push each other as soon as"));
  CHECK_THAT(own, Catch::Contains("/bodies/cone/geometry: its foremost particle ends"));
  CHECK_THAT(as_shipped, !Catch::Contains("/contact/0/normal") && !Catch::Contains("foremost particle"));
  CHECK_THAT(blunt, !Catch::Contains("warning"));
}

TEST_CASE("the check warns of bodies that come to a wall which is touched at its nodes")
{
  const TemporaryFolder folder;
  const auto scene = folder.write("ball.json", R"({
    "dimension": 2, "grid": { "upper": [1, 1], "cell_size": 0.05 }, "time": { "end": 0.3 }, "gravity": [0, -9.81],
    "boundaries": { "y+": "open" },
    "materials": { "gel": { "type": "neo_hookean", "density": 1000, "bulk_modulus": 1e6, "shear_modulus": 5e5 } },
    "bodies": { "ball": { "material": "gel", "geometry": { "type": "ball", "centre": [0.5, 0.5], "radius": 0.21 } } }
  })");
  const auto checked = [&](const std::string& assignments) {
    return tamp_with("check --no-trial " + scene.string() + assignments).out;
  };
  const std::string comes = "/boundaries/y-: ball comes to this wall, and is stopped as soon as its particles reach";

  CHECK_THAT(checked(""), Catch::Contains(comes) && Catch::Contains("up to 0.05 m before it touches"));
  CHECK_THAT(checked(" --set '/boundaries/y-={\"friction\":0,\"at_edges\":true}'"), !Catch::Contains("/boundaries/"));
  CHECK_THAT(checked(" --set /time/end=0.2"), !Catch::Contains("/boundaries/"));
  CHECK_THAT(checked(" --set /bodies/ball/geometry/centre='[0.5,0.21]'"), !Catch::Contains("/boundaries/"));
  CHECK_THAT(checked(" --set /bodies/ball/velocity='[-2,0]'"), Catch::Contains("/boundaries/x-: ball comes"));
}

TEST_CASE("the check says how a ball gets the mass that it should have", "[slow]")
{
  const std::string ball = "check --no-trial " TAMP_SOURCE_DIR "/inputs/savings/ball.json";
  const std::string in_lattice = tamp_with(ball).out,
                    on_rings = tamp_with(ball + " --set /bodies/ball/particles=rings").out;

  CHECK_THAT(in_lattice,
             Catch::Contains("of its mass") && Catch::Contains("with \"particles\": \"rings\" it is exact"));
  CHECK_THAT(on_rings, !Catch::Contains("of its mass"));
}

TEST_CASE("the check says how a cone gets the mass that it should have")
{
  const std::string rod = "check --no-trial " TAMP_SOURCE_DIR "/inputs/savings/rod.json --set /grid/cell_size=0.004";

  CHECK_THAT(tamp_with(rod).out,
             Catch::Contains("of its mass") && Catch::Contains("with \"particles\": \"cut\" it is right"));
  CHECK_THAT(tamp_with(rod + " --set /bodies/rod/particles=cut").out, !Catch::Contains("of its mass"));
}

TEST_CASE("a sand that is taken for another one than was tested is warned of by the check, and not by the run",
          "[slow]")
{
  CHECK(warns("/materials/sand/density=1700",
              "strains that were measured as engineering ones are read as logarithmic; in "
              "compression the material is then stiffer"));
  CHECK_FALSE(warns("/materials/sand/density=1700", "of the samples that were tested"));
  CHECK(warns("/materials/sand/density=1710", "/materials/sand/density: 1710 kg/m3 is +5 % off the 1624 kg/m3"));
  CHECK(run_with(quiet_punch + "--steps 1").summary["status"] == "completed");
}

TEST_CASE("a run with warnings says so at its end, and with --strict ends with 3")
{
  const std::string arguments = "--steps 2 --set /bodies/punch/velocity=[0,-6500]";

  const Run run = run_with(quiet_punch + arguments), strict = run_with(quiet_punch + arguments + " --strict");

  CHECK(run.outcome.exit_code == 0);
  CHECK(run.summary["status"] == "completed with warnings");
  CHECK(run.summary["warnings"].size() == 1);
  CHECK(strict.outcome.exit_code == 3);
  CHECK_THAT(strict.outcome.err, Catch::Contains("--strict"));
}

}  // namespace test_wrong_physics
