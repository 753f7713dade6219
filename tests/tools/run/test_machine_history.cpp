#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/scenes/history.hpp"
#include "tests/tools/program.hpp"

namespace test_machine_history
{

using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

const std::string scene = TAMP_SOURCE_DIR "/inputs/punch/quick.json --set /output/history_interval=2e-5 --quiet ";

std::vector<double> column_of(const std::vector<HistoryRow>& rows, const std::string& name)
{
  std::vector<double> column;
  column.reserve(rows.size());
  for (const HistoryRow& row : rows) column.push_back(row.at(name));
  return column;
}

bool never_falls(const std::vector<double>& values)
{
  return std::is_sorted(values.begin(), values.end());
}

}  // namespace

TEST_CASE("beside each row of the history stands what the run has taken of its machine until then")
{
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";

  REQUIRE(tamp_with("run " + scene + "--steps 20 --threads 1 --out " + run.string()).exit_code == 0);

  const auto rows = history_of(run / "machine.csv"), history = history_of(run / "history.csv");
  REQUIRE(rows.size() > 3);
  CHECK(column_of(rows, "step") == column_of(history, "step"));
  CHECK(column_of(rows, "time[s]") == column_of(history, "time[s]"));
  CHECK(never_falls(column_of(rows, "wall[s]")));
  CHECK(never_falls(column_of(rows, "processor[s]")));
  CHECK(rows.front().at("wall_per_step[s]") == 0);
  const auto summary = nlohmann::json::parse(read_text(run / "summary.json"));
  CHECK(rows.back().at("wall[s]") > 0);
  CHECK(rows.back().at("wall[s]") <= summary["wall_s"].get<double>());
  CHECK(rows.back().at("processor[s]") > 0);
  double in_steps = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    in_steps += (rows[i].at("step") - rows[i - 1].at("step")) * rows[i].at("wall_per_step[s]");
    CHECK(rows[i].at("rss[B]") > 1e6);
    CHECK(rows[i].at("rss[B]") <= summary["peak_rss_bytes"]["sum"].get<double>());
  }
  CHECK(in_steps > 0);
  CHECK(in_steps < rows.back().at("wall[s]"));
}

TEST_CASE("a run that is gone on with goes on with the times that it has taken")
{
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  REQUIRE(tamp_with("run " + scene + "--steps 25 --checkpoint-steps 20 --out " + run.string()).exit_code == 0);
  const auto before = history_of(run / "machine.csv");

  REQUIRE(tamp_with("run " + scene + "--steps 40 --restart " + run.string()).exit_code == 0);

  const auto rows = history_of(run / "machine.csv");
  CHECK(column_of(rows, "step") == column_of(history_of(run / "history.csv"), "step"));
  CHECK(rows.front() == before.front());
  CHECK(never_falls(column_of(rows, "wall[s]")));
  CHECK(never_falls(column_of(rows, "processor[s]")));
}

TEST_CASE("the memory of a run on ranks is that of all of them", "[mpiexec]")
{
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";

  REQUIRE(tamp_on_ranks(2, "run " + scene + "--steps 5 --threads 1 --out " + run.string()).exit_code == 0);

  const auto summary = nlohmann::json::parse(read_text(run / "summary.json"));
  const double resident = history_of(run / "machine.csv").back().at("rss[B]");
  CHECK(resident > summary["peak_rss_bytes"]["max"].get<double>());
  CHECK(resident <= summary["peak_rss_bytes"]["sum"].get<double>());
}

}  // namespace test_machine_history
