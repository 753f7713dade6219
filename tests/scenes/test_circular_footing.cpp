#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "tasks/simulation.hpp"
#include "tests/runtime/shared_cores.hpp"
#include "tests/scenes/history.hpp"
#include "tests/tools/program.hpp"
#include "tests/tools/rehearsal.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_circular_footing
{

using namespace tamp::test;

namespace
{

/// Bounds of the load that the clay of the scene bears on a circle of 1 m [N]: Tresca's clay whose hexagon is inscribed
/// in von Mises' circle bears 5.69 c for each area (G. Eason and R. T. Shield, Z. angew. Math. Phys. 11, 1960), and the
/// one whose hexagon is circumscribed 2 / sqrt(3) times that.
constexpr double least_load = 5.69 * 10e3 * std::numbers::pi / 4;
const double greatest_load = 2 / std::sqrt(3) * least_load;

struct Pressed {
  double load;  ///< mean force of contact from 0.24 s on, over which it changes by 1 % [N]
  double energy_error;
};

Pressed pressed(const std::string& anti_locking, double cell_size)
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();
  const Outcome outcome =
      tamp_with("run " TAMP_SOURCE_DIR "/inputs/footing/circular.json --quiet --out " + run + rehearsed +
                " --set /anti_locking=" + anti_locking + " --set /grid/cell_size=" + std::to_string(cell_size));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  double sum = 0;
  int n = 0;
  for (const HistoryRow& row : history_of(run + "/history.csv")) {
    if (row.at("time[s]") < 0.24) continue;
    sum += row.at("footing.contact_force_y[N]");
    ++n;
  }
  return {sum / n, nlohmann::json::parse(read_text(run + "/summary.json"))["energy_error"]};
}

}  // namespace

TEST_CASE("a circular footing bears about what limit analysis says with cell averages, too much without",
          "[scenes][slow][pinned]")
{
  const Pressed coarse = pressed("cell_average", 0.1), fine = pressed("cell_average", 0.05),
                plain = pressed("none", 0.05);

  CAPTURE(least_load, greatest_load, coarse.load, fine.load, plain.load, coarse.energy_error, fine.energy_error,
          plain.energy_error);
  if (is_rehearsal) return;
  // How far the loads themselves are off is pinned from results/verification/tests_of_axisymmetry.csv.
  CHECK(plain.load > 1.1 * greatest_load);
  CHECK(fine.load < 1.05 * greatest_load);
  CHECK(fine.load < coarse.load);
  // The limit by first order, as layers in which clay shears are some cells thick.
  const double limit = 2 * fine.load - coarse.load;
  CHECK(limit > least_load);
  CHECK(limit < greatest_load);
  for (const Pressed& run : {coarse, fine, plain}) CHECK(run.energy_error < 1e-4);
}

TEST_CASE("a circular footing on clay that shares its volume has the same digest on any ranks and threads",
          "[ranks][slow]")
{
  const std::string anti_locking = GENERATE("cell_average", "f_bar");
  const auto scene = tamp::tools::read_scene(TAMP_SOURCE_DIR "/inputs/footing/circular.json",
                                             std::vector{"/anti_locking=" + anti_locking})
                         .scene;
  const auto digest = [&](int n_threads, const tamp::runtime::Communicator& communicator) {
    const auto simulation = tamp::tasks::Simulation::make(
        scene, std::make_shared<tamp::runtime::Executor>(n_threads, on_shared_cores()), communicator);
    for (int n = 0; n < n_steps_of(100); ++n) simulation->advance(1);
    return simulation->digest();
  };
  const std::string alone = digest(1, {});

  for (const int n_threads : {1, 2}) CHECK(digest(n_threads, tamp::runtime::Communicator::world()) == alone);
}

}  // namespace test_circular_footing
