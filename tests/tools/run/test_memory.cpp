#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/scenes/count_allocations.hpp"
#include "tests/tools/program.hpp"

namespace test_memory
{

using namespace tamp::test;

TEST_CASE("what is forecast of memory, what the ledger knows of and what a process grows by agree", "[slow]")
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();
  // 360,000 particles.
  const std::string scene =
      TAMP_SOURCE_DIR "/inputs/uxo/quick.json --set /grid/cell_size=0.0033333333333333335 --set /grid/patches=[1,1,6] ";

  REQUIRE(tamp_with("run " + scene + "--quiet --steps 3 --checkpoint-steps 2 --threads 1 --out " + run).exit_code == 0);

  const nlohmann::json memory = nlohmann::json::parse(read_text(run + "/summary.json"))["memory"];
  const auto ledger = memory["ledger_bytes"].get<double>();
  CHECK(ledger > 2e8);
  const Outcome shown = tamp_with("profile " + run + " --memory");
  CHECK(shown.exit_code == 0);
  CHECK_THAT(shown.out, Catch::Contains("deformation gradient") && Catch::Contains("copies for output") &&
                            Catch::Contains("particles to grid"));
  if (!counts_allocations) return;
  CHECK(memory["forecast_bytes"].get<double>() == Approx(ledger).epsilon(0.05));
  CHECK(memory["process_bytes"].get<double>() == Approx(ledger).epsilon(0.05));
}

}  // namespace test_memory
