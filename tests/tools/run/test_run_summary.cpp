#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_run_summary
{

/// A run ends by saying what its scene is about.
using namespace tamp::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace
{

/// A block thrown upwards, which is highest after 0.1 s.
const char* const thrown = R"({
  "dimension": 2,
  "grid": { "upper": [2, 2], "cell_size": 0.25 },
  "boundaries": { "x-": "open", "x+": "open", "y-": "open", "y+": "open" },
  "time": { "end": 0.15, "maximum_step": 1e-3 },
  "gravity": [0, -10],
  "materials": { "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e5, "shear_modulus": 1e5 } },
  "bodies": {
    "block": {
      "material": "steel", "rigid": true, "geometry": { "type": "box", "lower": [0.5, 1], "upper": [1, 1.5] },
      "velocity": [0, 1]
    }
  },
  "output": { "history_interval": 1e-3 }
})";

/// A soft block, and a stiff one that drifts beside it.
const char* const two_blocks = R"({
  "dimension": 2,
  "grid": { "upper": [2.4, 1.2], "cell_size": 0.1, "patches": [2, 1] },
  "boundaries": { "x-": "open", "x+": "open", "y-": "open", "y+": "open" },
  "time": { "end": 0.01 },
  "materials": {
    "soft": { "type": "hypoelastic", "density": 1000, "bulk_modulus": 1e6, "shear_modulus": 5e5 },
    "stiff": { "type": "hypoelastic", "density": 1000, "bulk_modulus": 1e8, "shear_modulus": 5e7 }
  },
  "bodies": {
    "left": { "material": "soft", "geometry": { "type": "box", "lower": [0.3, 0.4], "upper": [0.7, 0.8] } },
    "right": {
      "material": "stiff", "geometry": { "type": "box", "lower": [1.2, 0.4], "upper": [1.6, 0.8] }, "velocity": [1, 0]
    }
  }
})";

Json summary_of(const fs::path& folder)
{
  return Json::parse(read_text(folder / "summary.json"));
}

}  // namespace

TEST_CASE("the first line of a result is how deep a body was, when, and where it is now")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";

  const Outcome outcome = tamp_with("run " + folder.write("thrown.json", thrown).string() + " --out " + out.string());

  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Catch::Contains("\n\nblock: deepest 0.05 m at 100 ms, now 0.0375 m"));
  CHECK_THAT(outcome.out, Catch::Contains("scheduler overhead"));
  const Json summary = summary_of(out);
  CHECK(summary["bodies"]["block"]["deepest_m"].get<double>() == Approx(0.05).epsilon(1e-3));
  CHECK(summary["bodies"]["block"]["deepest_at_s"].get<double>() == Approx(0.1).margin(2e-3));
  CHECK(summary["greatest"]["kinetic[J]"]["time_s"] == 0);
  CHECK_FALSE(summary["greatest"].contains("step"));
}

TEST_CASE("particle updates a second are those that were made in the time of the steps, a slow one included")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";
  const std::string scene = folder.write("thrown.json", thrown).string();
  const auto rate_from = [&](long first) {
    const Json summary = summary_of(out);
    const double n =
        summary["particles"]["total"].get<double>() * static_cast<double>(summary["steps"].get<long>() - first);
    CHECK(summary["particle_updates_per_s"].get<double>() ==
          Approx(n / summary["wall_parts_s"]["steps"].get<double>()));
  };

  REQUIRE(tamp_with("run " + scene + " --quiet --steps 20 --checkpoint-steps 10 --out " + out.string()).exit_code == 0);
  rate_from(0);
  REQUIRE(tamp_with("run " + scene + " --quiet --steps 60 --restart " + out.string()).exit_code == 0);
  rate_from(summary_of(out)["restarted_at_step"].get<long>());
}

TEST_CASE("a run that goes on knows the greatest of the rows before", "[slow]")
{
  const TemporaryFolder folder;
  const std::string scene = folder.write("thrown.json", thrown).string();
  const fs::path straight = folder.path() / "straight", parted = folder.path() / "parted";
  REQUIRE(tamp_with("run " + scene + " --quiet --out " + straight.string()).exit_code == 0);
  REQUIRE(
      tamp_with("run " + scene + " --quiet --until 0.12 --checkpoint-steps 10 --out " + parted.string()).exit_code ==
      0);

  REQUIRE(tamp_with("run " + scene + " --quiet --restart " + parted.string()).exit_code == 0);

  CHECK(summary_of(parted)["greatest"] == summary_of(straight)["greatest"]);
}

TEST_CASE("a run says which particles set its time step, and how many steps each material and the rest set")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";

  REQUIRE(tamp_with("run " + folder.write("blocks.json", two_blocks).string() + " --quiet --out " + out.string())
              .exit_code == 0);

  const Json summary = summary_of(out);
  const Json &steps = summary["time_step"], &set_by = steps["set_by"];
  CAPTURE(steps.dump());
  CHECK(steps["first"]["step"] == 2);
  for (const char* which : {"first", "shortest", "last"}) {
    const Json& step = steps[which];
    CHECK(step["material"] == "stiff");
    // The particles of the soft block come first.
    CHECK(step["particle"].get<int>() >= 64);
    CHECK(step["position_m"].size() == 2);
    CHECK(step["J"].get<double>() == Approx(1).margin(1e-3));
    CHECK(step["pressure_Pa"].get<double>() == Approx(0).margin(1e3));
    // sqrt((K + 4G/3) / density)
    CHECK(step["wave_speed_m_per_s"].get<double>() == Approx(408.2).epsilon(1e-3));
  }
  CHECK(steps["shortest"]["size_s"].get<double>() <= steps["first"]["size_s"].get<double>());
  CHECK(set_by["particles"]["soft"] == 0);
  CHECK(set_by["start"] == 1);
  CHECK(set_by["end"] == 1);
  CHECK(set_by["particles"]["stiff"].get<long>() == summary["steps"].get<long>() - 2);
  CHECK(steps["last"]["step"].get<long>() == summary["steps"].get<long>() - 1);
}

TEST_CASE("a run that is rigid has no particle that sets its time step")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";

  REQUIRE(
      tamp_with("run " + folder.write("thrown.json", thrown).string() + " --quiet --out " + out.string()).exit_code ==
      0);

  const Json steps = summary_of(out)["time_step"];
  CHECK(steps["first"].is_null());
  CHECK(steps["last"].is_null());
  CHECK(steps["set_by"]["particles"].empty());
  CHECK(steps["set_by"]["maximum_step"].get<long>() > 100);
}

TEST_CASE("a run that goes on knows what set the steps before", "[slow]")
{
  const TemporaryFolder folder;
  const std::string scene = folder.write("blocks.json", two_blocks).string();
  const fs::path straight = folder.path() / "straight", parted = folder.path() / "parted";
  REQUIRE(tamp_with("run " + scene + " --quiet --out " + straight.string()).exit_code == 0);
  REQUIRE(tamp_with("run " + scene + " --quiet --steps 15 --checkpoint-steps 10 --out " + parted.string()).exit_code ==
          0);

  REQUIRE(tamp_with("run " + scene + " --quiet --restart " + parted.string()).exit_code == 0);

  CHECK(summary_of(parted)["restarted_at_step"].get<long>() >= 10);
  CHECK(summary_of(parted)["time_step"] == summary_of(straight)["time_step"]);
}

}  // namespace test_run_summary
