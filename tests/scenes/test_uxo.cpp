#include <Eigen/Core>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tasks/simulation.hpp"
#include "tests/runtime/shared_cores.hpp"
#include "tests/scenes/history.hpp"
#include "tests/tools/program.hpp"
#include "tools/run/run.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools::test_uxo
{

namespace
{

/// Settings that make a shipped scene of the projectile small: cells twice as large, and fewer particles in the
/// projectile.
const std::vector<std::string> small{"/grid/cell_size=0.01", "/grid/patches=[1,2,4]",
                                     "/materials/projectile/particles_per_axis=8", "/output/history_interval=1e-7"};

const std::string by_regression = R"(/contact/0/normal="regression")";

std::filesystem::path shipped(const std::string& name)
{
  return std::filesystem::path(TAMP_SOURCE_DIR) / "inputs/uxo" / name;
}

Eigen::Vector3d place(const test::HistoryRow& row, const std::string& name)
{
  return {row.at(name + "_x[m]"), row.at(name + "_y[m]"), row.at(name + "_z[m]")};
}

/// The command line of a run of the small quick scene, with the contact that takes most tasks.
std::string run_with(const std::string& options)
{
  std::string command = "run " + shipped("quick.json").string() + " --quiet " + options;
  for (const std::string& assignment : small) command += " --set " + assignment;
  command += " --set '" + by_regression + "'";
  return command;
}

nlohmann::json summary_of(const std::filesystem::path& folder)
{
  return nlohmann::json::parse(std::ifstream(folder / "summary.json"));
}

/// A block of 4 x 4 x 2 cells goes up at 3 m/s between walls, and out through the open top at 0.8 m.
const char* ejected_block = R"({
  "dimension": 3,
  "grid": { "upper": [0.8, 0.8, 0.8], "cell_size": 0.1, "patches": [2, 1, 2] },
  "boundaries": { "z+": "open" },
  "time": { "end": 0.2, "maximum_step": 0.01 },
  "materials": { "clay": { "type": "hypoelastic", "density": 1500, "bulk_modulus": 1e5, "shear_modulus": 5e4 } },
  "bodies": {
    "block": {
      "material": "clay",
      "geometry": { "type": "box", "lower": [0.2, 0.2, 0.4], "upper": [0.6, 0.6, 0.6] },
      "velocity": [0, 0, 3]
    }
  },
  "output": { "fields_interval": 1, "history_interval": 0.01 }
})";

}  // namespace

TEST_CASE("the projectile's history follows nose, tail and angle, and the sand near the nose", "[scenes]")
{
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  options.max_steps = 12;
  options.n_threads = 2;
  options.quiet = true;

  // With its own normal it meets the sand in the first step.
  std::vector<std::string> assignments = small;
  assignments.push_back(R"(/contact/0/normal="projectile")");
  run(read_scene(shipped("quick.json"), assignments), options);

  const auto rows = test::history_of(options.folder / "history.csv");
  REQUIRE(rows.size() == 13);
  CHECK(rows[0].at("projectile.axis_angle[deg]") == Approx(45).margin(1e-9));
  CHECK(rows[0].at("projectile.depth[m]") == 0);
  double most_compacted = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const test::HistoryRow& row = rows[i];
    const Eigen::Vector3d axis = place(row, "projectile.nose") - place(row, "projectile.tail");
    REQUIRE(axis.norm() == Approx(0.041).margin(1e-9));
    const double angle = row.at("projectile.axis_angle[deg]") * std::numbers::pi / 180;
    REQUIRE(std::sin(angle) == Approx(-axis[2] / axis.norm()).margin(1e-9));
    for (const char* peak : {"p_max[Pa]", "q_max[Pa]", "cap_max[Pa]", "plastic_volumetric_max[-]"}) {
      REQUIRE(row.at(std::string("sand.near_nose.") + peak) <= row.at(std::string("sand.") + peak));
    }
    REQUIRE(row.at("sand.near_nose.plastic_volumetric_min[-]") >= row.at("sand.plastic_volumetric_min[-]"));
    most_compacted = std::max(most_compacted, row.at("sand.near_nose.plastic_volumetric_max[-]"));
    if (i == 0) continue;
    // The sand pushes it back and up, and it slows down.
    REQUIRE(row.at("projectile.contact_force_x[N]") < 0);
    REQUIRE(row.at("projectile.contact_force_z[N]") > 0);
    REQUIRE(row.at("projectile.velocity_x[m/s]") < rows[i - 1].at("projectile.velocity_x[m/s]"));
    const double advance = row.at("projectile.depth[m]") - rows[i - 1].at("projectile.depth[m]");
    REQUIRE(advance > 0);
    REQUIRE(advance < 283 * row.at("dt[s]"));
  }
  CHECK(most_compacted > 0.01);
  CHECK(rows.back().at("lost[particles]") == 0);
}

TEST_CASE("every scene of the projectile has the same digest on any ranks and threads", "[ranks][slow]")
{
  const std::string name = GENERATE("quick.json", "fine.json", "table.json", "svr.json", "mlp.json");
  std::vector<std::string> assignments = small;
  if (name == "quick.json") assignments.push_back(by_regression);
  const auto checked = read_scene(shipped(name), assignments);
  const auto digest = [&](int n_threads, const runtime::Communicator& communicator) {
    const auto simulation = tasks::Simulation::make(
        checked.scene, std::make_shared<runtime::Executor>(n_threads, test::on_shared_cores()), communicator);
    for (int n = 0; n < 5; ++n) simulation->advance(1);
    return simulation->digest();
  };
  const std::string alone = digest(1, {});

  INFO(name);
  for (const int n_threads : {1, 2}) CHECK(digest(n_threads, runtime::Communicator::world()) == alone);
}

TEST_CASE("a projectile's run that goes on in mid-flight ends with the bits and the history of a straight one",
          "[mpiexec]")
{
  const test::TemporaryFolder folder;
  const auto straight = folder.path() / "straight", broken = folder.path() / "broken";

  REQUIRE(test::tamp_with(run_with("--steps 14 --threads 2 --out " + straight.string())).exit_code == 0);
  REQUIRE(test::tamp_with(run_with("--steps 11 --threads 1 --checkpoint-steps 8 --out " + broken.string())).exit_code ==
          0);
  REQUIRE(test::tamp_on_ranks(2, run_with("--steps 14 --threads 1 --restart " + broken.string())).exit_code == 0);

  const nlohmann::json summary = summary_of(broken);
  CHECK(summary["restarted_at_step"] == 8);
  CHECK(summary["state_digest"] == summary_of(straight)["state_digest"]);
  CHECK(test::read_text(broken / "history.csv") == test::read_text(straight / "history.csv"));
}

TEST_CASE("ejecta that leave through the open top are counted with their mass and momentum", "[scenes]")
{
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  options.quiet = true;

  run(read_scene(folder.write("block.json", ejected_block)), options);

  const double mass = 1500 * 0.4 * 0.4 * 0.2;
  const auto rows = test::history_of(options.folder / "history.csv");
  bool some_left = false;
  for (const test::HistoryRow& row : rows) {
    // The block's 4 layers of 64 particles stand 0.05 m apart, the upper one at 0.575 m at the start.
    const double rise = 3 * row.at("time[s]");
    double n_layers = 0;
    for (const double z : {0.425, 0.475, 0.525, 0.575}) n_layers += z + rise > 0.8 ? 1 : 0;
    some_left = some_left || (n_layers > 0 && n_layers < 4);
    REQUIRE(row.at("lost[particles]") == 64 * n_layers);
    REQUIRE(row.at("lost_mass[kg]") == Approx(mass * n_layers / 4).epsilon(1e-13));
    REQUIRE(row.at("lost_momentum_z[N s]") == Approx(3 * mass * n_layers / 4).epsilon(1e-10));
    REQUIRE(std::abs(row.at("lost_momentum_x[N s]")) < 1e-10 * mass);
    REQUIRE(row.at("momentum_z[N s]") + row.at("lost_momentum_z[N s]") == Approx(3 * mass).epsilon(1e-10));
  }
  CHECK(some_left);
  CHECK(rows.back().at("lost[particles]") == 256);
  // Nothing is known of a body that has left.
  CHECK(std::isnan(rows.back().at("block.velocity_z[m/s]")));
  CHECK(test::read_text(options.folder / "history.csv").find("-nan") == std::string::npos);
}

}  // namespace tamp::tools::test_uxo
