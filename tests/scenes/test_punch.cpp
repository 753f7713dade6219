#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tasks/simulation.hpp"
#include "tests/scenes/history.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/run/run.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools::test_punch
{

namespace
{

CheckedScene shipped(const std::string& name, const std::vector<std::string>& assignments = {})
{
  return read_scene(std::filesystem::path(TAMP_SOURCE_DIR) / "inputs/punch" / name, assignments);
}

std::string digest_after(const std::string& name, int n_steps, int n_threads)
{
  const auto simulation = tasks::Simulation::make(shipped(name).scene, n_threads);
  for (int n = 0; n < n_steps; ++n) simulation->advance(1);
  return simulation->digest();
}

nlohmann::json json_of(const std::filesystem::path& file)
{
  return nlohmann::json::parse(std::ifstream(file));
}

}  // namespace

TEST_CASE("the punch scenes have the same digest on one, two and three threads", "[scenes][slow]")
{
  CHECK(digest_after("quick.json", 60, 2) == digest_after("quick.json", 60, 1));
  CHECK(digest_after("quick.json", 60, 3) == digest_after("quick.json", 60, 1));
  for (const char* scene : {"table.json", "svr.json", "mlp.json"}) {
    CHECK(digest_after(scene, 15, 2) == digest_after(scene, 15, 1));
  }
}

TEST_CASE("the punch has the same digest in any order of tasks that its graph allows", "[scenes]")
{
  const auto shuffled = [](std::uint64_t seed) {
    const auto simulation = tasks::Simulation::make(shipped("quick.json").scene, runtime::Executor::shuffled(seed));
    for (int n = 0; n < 60; ++n) simulation->advance(1);
    return simulation->digest();
  };
  const std::string serial = digest_after("quick.json", 60, 1);

  for (const std::uint64_t seed : {1U, 2U, 3U}) CHECK(shuffled(seed) == serial);
}

TEST_CASE("the quick punch runs on in state form, where the SVR sand needs the smallest substeps", "[scenes][slow]")
{
  const auto simulation = tasks::Simulation::make(
      shipped("quick.json", {"/materials/sand/modulus/type=svr", "/materials/sand/elastic_update=state"}).scene, 2);

  for (int n = 0; n < 300; ++n) simulation->advance(1);

  CHECK(simulation->updates().limited_substeps > 0);
  CHECK(simulation->updates().failures == 0);
}

TEST_CASE("a digest tells two states apart", "[scenes]")
{
  CHECK(digest_after("quick.json", 3, 1) != digest_after("quick.json", 4, 1));
}

TEST_CASE("the cut into patches changes the punch by round-off only", "[scenes]")
{
  const auto kinetic = [](const std::string& patches) {
    const auto simulation = tasks::Simulation::make(shipped("quick.json", {"/grid/patches=" + patches}).scene, 2);
    for (int n = 0; n < 10; ++n) simulation->advance(1);
    return simulation->report().kinetic;
  };

  const double whole = kinetic("[1,1]");

  CHECK(kinetic("[2,2]") == Approx(whole).epsilon(1e-12));
  CHECK(kinetic("[5,4]") == Approx(whole).epsilon(1e-12));
}

TEST_CASE("the quick punch keeps energy, momentum and particles while it is driven in", "[scenes]")
{
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  options.n_threads = 2;
  options.until = 4e-4;
  options.quiet = true;

  run(shipped("quick.json"), options);

  const nlohmann::json summary = json_of(options.folder / "summary.json");
  const auto rows = test::history_of(options.folder / "history.csv");
  const auto& row = rows.back();
  // Sand that is looser than any test bears too little to warn, and none is beyond the largest strain.
  CHECK(summary["warnings"].empty());
  CHECK(summary["monitors"]["looser_than_tested"]["warns"] == false);
  CHECK(summary["monitors"]["modulus_extrapolations_looser"] > 0);
  CHECK(summary["monitors"]["out_of_range"]["share"] < 0.01);
  CHECK(summary["simulated_time_s"] == 4e-4);
  CHECK(summary["energy_error"].get<double>() < 2e-3);
  for (const auto& any : rows) CHECK(any.at("total[J]") == Approx(rows.front().at("total[J]")).epsilon(2e-3));
  CHECK(summary["momentum_error"].get<double>() < 1e-12);
  CHECK(summary["particles"]["lost"] == 0);
  // It goes on at no more than 200 m/s, and is slowed down by the sand's momentum alone to no less than half of that.
  CHECK(row.at("punch.depth[m]") < 200 * 4e-4);
  CHECK(row.at("punch.depth[m]") > 100 * 4e-4);
  CHECK(std::abs(row.at("punch.tilt[deg]")) < 1e-6);
  // The scene is symmetric, so nothing goes sideways.
  CHECK(std::abs(row.at("momentum_x[N s]")) < 1e-9 * std::abs(row.at("momentum_y[N s]")));
  CHECK(row.at("total[J]") ==
        Approx(row.at("kinetic[J]") + row.at("elastic[J]") + row.at("plastic[J]") + row.at("viscous[J]") +
               row.at("contact[J]") + row.at("filter[J]") - row.at("half_step[J]") - row.at("external[J]")));
}

TEST_CASE("a run's folder holds what scripts rely on", "[scenes]")
{
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  options.max_steps = 30;
  options.quiet = true;

  run(shipped("quick.json"), options);

  for (const char* name :
       {"scene.json", "history.csv", "summary.json", "fields.h5", "fields.xdmf", "profile.json", "trace.json"}) {
    CHECK(std::filesystem::file_size(options.folder / name) > 0);
  }
  const nlohmann::json summary = json_of(options.folder / "summary.json");
  for (const char* key : {"status",
                          "reason",
                          "scene",
                          "version",
                          "ranks",
                          "threads",
                          "patches",
                          "particles",
                          "steps",
                          "simulated_time_s",
                          "time_step",
                          "wall_s",
                          "wall_per_step_s",
                          "particle_updates_per_s",
                          "peak_rss_bytes",
                          "forecast_peak_bytes",
                          "ledger_peak_bytes",
                          "energy_error",
                          "momentum_error",
                          "state_digest",
                          "bodies",
                          "materials",
                          "monitors"}) {
    CHECK(summary.contains(key));
  }
  CHECK(summary["steps"] == 30);
  CHECK(summary["ledger_peak_bytes"].get<double>() >= summary["forecast_peak_bytes"].get<double>());
  double wall = 0;
  for (const auto& part : summary["wall_parts_s"]) wall += part.get<double>();
  CHECK(wall <= summary["wall_s"].get<double>());
  CHECK(wall > 0.9 * summary["wall_s"].get<double>());
  double shares = 0;
  const nlohmann::json profile = json_of(options.folder / "profile.json");
  for (const auto& task : profile["tasks"]) shares += task["share"].get<double>();
  CHECK(shares == Approx(1).margin(1e-9));
  // The resolved scene can be run again as it is.
  CHECK(read_scene(options.folder / "scene.json").scene.bodies.size() == 2);
}

TEST_CASE("a run whose step becomes too small stops and keeps its last good state", "[scenes]")
{
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  options.quiet = true;

  CHECK_THROWS_WITH(run(shipped("quick.json", {"/time/minimum_step=4e-6"}), options),
                    Catch::Contains("below the minimum") && Catch::Contains("step ") && Catch::Contains("time "));

  const nlohmann::json summary = json_of(options.folder / "summary.json");
  CHECK(summary["status"] == "unstable");
  CHECK(summary["reason"].get<std::string>().find("below the minimum") != std::string::npos);
  CHECK(test::history_of(options.folder / "history.csv").back().at("step") == summary["steps"].get<double>());
}

}  // namespace tamp::tools::test_punch
