#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/tools/run/run_with.hpp"
#include "tools/run/forecast.hpp"

namespace test_monitors
{

using namespace tamp;
using namespace tamp::test;
using namespace tamp::tools;

namespace
{

const std::string inputs = TAMP_SOURCE_DIR "/inputs/";
const std::string punch = TAMP_SOURCE_DIR "/inputs/punch/quick.json --quiet --steps 200";

}  // namespace

TEST_CASE("each monitor warns beyond the limit that the scene sets, and --strict ends with 3", "[slow]")
{
  const std::string name =
      GENERATE("looser_than_tested", "filtered_energy", "energy_drift", "null_space", "uneven_pressure");
  const std::string limit = " --set /limits/" + name + "=";

  const Run beyond = run_with(punch + limit + "0"), within = run_with(punch + limit + "1"),
            strict = run_with(punch + limit + "0 --strict");

  const nlohmann::json& monitor = beyond.summary["monitors"][name];
  CAPTURE(name, monitor.dump());
  CHECK(monitor["warns"] == true);
  CHECK(monitor["limit"] == 0);
  CHECK(monitor["share"].get<double>() > 0);
  CHECK(beyond.summary["status"] == "completed with warnings");
  CHECK(beyond.outcome.exit_code == 0);
  CHECK_THAT(beyond.outcome.err, Catch::Contains("more than /limits/" + name + ", 0 %"));
  CHECK(within.summary["monitors"][name]["warns"] == false);
  CHECK(within.summary["monitors"][name]["share"] == monitor["share"]);
  CHECK(within.summary["status"] == "completed");
  CHECK(strict.outcome.exit_code == 3);
}

TEST_CASE("sand that has dilated is told as looser than tested, and crushed sand as beyond the largest strain",
          "[slow]")
{
  const std::string limits = " --set /limits/looser_than_tested=0.005 --set /limits/out_of_range=0.005";
  const Run loose = run_with(punch + limits),
            crushed = run_with(punch + limits + " --set /bodies/punch/velocity=[0,-1500]");

  const auto warns = [](const Run& run, const char* name) { return run.summary["monitors"][name]["warns"] == true; };
  INFO(loose.outcome.err << crushed.outcome.err);
  CHECK(warns(loose, "looser_than_tested"));
  CHECK_FALSE(warns(loose, "out_of_range"));
  CHECK_THAT(loose.outcome.err, Catch::Contains("tests of looser samples") && !Catch::Contains("larger strains"));
  CHECK(warns(crushed, "out_of_range"));
  CHECK_FALSE(warns(crushed, "looser_than_tested"));
  CHECK_THAT(crushed.outcome.err, Catch::Contains("measurements to larger strains") && !Catch::Contains("looser"));
}

TEST_CASE("local damping of what falls is told, and what comes to rest or is pressed slowly is left alone")
{
  const Run falling = run_with(inputs + "stability/scenes/fall.json --quiet --set /local_damping=0.5");
  const Run settled = run_with(inputs + "verification/scenes/self_weight.json --quiet");
  const Run pressed = run_with(inputs + "footing/quick.json --quiet --until 0.35");

  const auto damped = [](const Run& run) { return run.summary["monitors"]["damped_energy"]; };
  CAPTURE(damped(falling).dump(), damped(settled).dump(), damped(pressed).dump());
  // The block falls at half of gravity.
  CHECK(damped(falling)["share"].get<double>() == Approx(0.5).margin(0.01));
  CHECK(damped(falling)["warns"] == true);
  CHECK(damped(falling)["first"]["time_s"].get<double>() < 0.05);
  CHECK_THAT(falling.outcome.err, Catch::Contains("taken by local damping"));
  CHECK(damped(settled)["share"].get<double>() < 1e-6);
  CHECK(settled.summary["energies_J"]["viscous"].get<double>() > 100);
  CHECK(damped(pressed)["share"].get<double>() > 0);
  CHECK(damped(pressed)["warns"] == false);
}

TEST_CASE("contact before bodies touch is told with its place and materials, and contact where they touch is not")
{
  const std::string approach = inputs + "stability/scenes/approach.json --quiet --set /limits/sampled_every=5";
  const Run early = run_with(approach), late = run_with(approach + " --set /contact/0/normal=regression");

  const nlohmann::json seen = early.summary["monitors"]["early_contact"];
  CAPTURE(seen.dump());
  CHECK(seen["warns"] == true);
  CHECK(seen["first"]["materials"] == nlohmann::json({"ground", "block"}));
  // Between the ground's surface and where the block's lower face starts.
  CHECK(seen["first"]["position_m"][1].get<double>() >= 0.3);
  CHECK(seen["first"]["position_m"][1].get<double>() <= 0.4);
  CHECK_THAT(early.outcome.err, Catch::Contains("'ground' and 'block' at ("));
  CHECK(late.summary["monitors"]["early_contact"]["share"] == 0);
}

TEST_CASE("contact along a wrong normal, with one body within the other, is told")
{
  const std::string sliding = inputs +
                              "verification/scenes/block_on_incline.json --quiet --until 0.1 "
                              "--set /interpolator=quadratic_spline --set /limits/sampled_every=20";
  const Run caught = run_with(sliding), right = run_with(sliding + " --set /contact/0/normal=ground");

  const nlohmann::json seen = caught.summary["monitors"]["interpenetration"];
  CAPTURE(seen.dump());
  CHECK(seen["warns"] == true);
  CHECK(seen["first"]["materials"] == nlohmann::json({"ground", "block"}));
  CHECK(right.summary["monitors"]["interpenetration"]["share"] == 0);
  CHECK(right.summary["monitors"]["interpenetration"]["first"] == nullptr);
}

TEST_CASE("a forecast that was missed is told with what it was of, and only a run to the end is held against its steps")
{
  const std::string exact = inputs + "stability/scenes/approach.json --set /limits/forecast_missed=1";
  const Run whole = run_with(exact), part = run_with(exact + " --steps 20");

  const nlohmann::json missed = whole.summary["monitors"]["forecast_missed"];
  const double steps = whole.summary["steps"].get<double>() / whole.summary["forecast"]["steps"].get<double>();
  CHECK(missed["share"].get<double>() == Approx(std::max(steps, 1 / steps)));
  CHECK(missed["warns"] == true);
  CHECK_THAT(whole.outcome.err, Catch::Contains("times off: the forecast of the run's steps"));
  CHECK(part.summary["monitors"]["forecast_missed"]["share"] == 1);
  CHECK(part.summary["monitors"]["forecast_missed"]["warns"] == false);
}

TEST_CASE("more memory, disk space or steps than forecast are missed by their factor, and fewer steps too")
{
  Forecast forecast;
  forecast.memory = 120;
  forecast.at_start = 20;
  forecast.disk = 1e6;
  forecast.pace = tasks::Pace{.n_steps = 100, .core_seconds = 1};
  const auto missed = [&](const UsedByRun& taken) { return miss_of(forecast, taken); };

  CHECK(missed({.memory = 50, .disk = 5e5, .n_steps = 100}).factor == 1);
  CHECK(missed({.memory = 300, .disk = 2e6, .n_steps = 100}).factor == 3);
  CHECK(missed({.memory = 300, .disk = 2e6, .n_steps = 100}).what == "memory");
  CHECK(missed({.memory = 100, .disk = 4e6, .n_steps = 300}).what == "disk space");
  CHECK(missed({.memory = 100, .disk = 0, .n_steps = 250}).factor == 2.5);
  CHECK(missed({.memory = 100, .disk = 0, .n_steps = 25}).factor == 4);
  CHECK(missed({.memory = 100, .disk = 0, .n_steps = {}}).factor == 1);
}

TEST_CASE("the monitor that is furthest beyond its limit comes first")
{
  const Run run = run_with(punch + " --set /limits/filtered_energy=1e-9 --set /limits/energy_drift=1e-3");

  CHECK(run.summary["warnings"][0].get<std::string>().find("/limits/filtered_energy") != std::string::npos);
  const std::size_t n_warnings = run.summary["warnings"].size();
  const nlohmann::json monitors = run.summary["monitors"];
  std::size_t n_warning = 0;
  for (const auto& monitor : monitors) {
    if (monitor.is_object() && monitor["warns"] == true) ++n_warning;
  }
  CHECK(n_warning == n_warnings);
}

TEST_CASE("what samples and rows of the history saw goes on after a restart", "[slow]")
{
  const TemporaryFolder folder;
  const auto straight = folder.path() / "straight", halves = folder.path() / "halves";
  const std::string scene = std::string("run ") + TAMP_SOURCE_DIR + "/inputs/punch/quick.json --quiet ";
  const std::string limit =
      " --set /limits/null_space=1e-9 --set /limits/looser_than_tested=1e-9 --set /limits/filtered_energy=1e-9 "
      "--steps ";
  REQUIRE(tamp_with(scene + "--out " + straight.string() + limit + "200").exit_code == 0);
  REQUIRE(tamp_with(scene + "--out " + halves.string() + limit + "120 --checkpoint-steps 120").exit_code == 0);

  REQUIRE(tamp_with(scene + "--restart " + halves.string() + limit + "200").exit_code == 0);

  const auto seen_in = [](const std::filesystem::path& run, const char* monitor) {
    return nlohmann::json::parse(read_text(run / "summary.json"))["monitors"][monitor];
  };
  CHECK(seen_in(straight, "null_space")["count"] == 4);
  CHECK(seen_in(straight, "null_space")["first"]["after_step"] == 50);
  CHECK(seen_in(straight, "looser_than_tested")["first"]["after_step"] == 50);
  // From the first row of the history after the start.
  CHECK(seen_in(straight, "filtered_energy")["first"]["after_step"].get<long>() > 0);
  CHECK(seen_in(straight, "filtered_energy")["first"]["after_step"].get<long>() < 50);
  for (const char* monitor : {"null_space", "looser_than_tested", "filtered_energy"}) {
    CHECK(seen_in(halves, monitor) == seen_in(straight, monitor));
  }
}

TEST_CASE("a limit that is negative, or of nothing that is watched, is refused with its place")
{
  const Outcome negative = tamp_with("run " + punch + " --set /limits/null_space=-0.1");
  const Outcome unknown = tamp_with("run " + punch + " --set /limits/nul_space=0.1");

  CHECK(negative.exit_code == 2);
  CHECK_THAT(negative.err, Catch::Contains("/limits/null_space") && Catch::Contains("-0.1"));
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Catch::Contains("nul_space") && Catch::Contains("null_space"));
}

}  // namespace test_monitors
