#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_redone_steps
{

using namespace tamp::test;

namespace
{

/// The quick punch at a speed at which the published rule's steps strain sand by more than a material takes.
const std::string fast = TAMP_SOURCE_DIR
    "/inputs/punch/quick.json --quiet --steps 40 --set /bodies/punch/velocity=[0,-1000] --set /time/rule=published "
    "--set /time/multiplier=1";

nlohmann::json summary_of(const std::filesystem::path& run)
{
  return nlohmann::json::parse(read_text(run / "summary.json"));
}

}  // namespace

TEST_CASE("a run tries a step that goes wrong again, and ends with 3 and a checkpoint that goes on where it may not",
          "[slow]")
{
  const TemporaryFolder folder;
  const auto redone = folder.path() / "redone", rescued = folder.path() / "rescued";

  const Outcome with = tamp_with("run " + fast + " --out " + redone.string());
  const Outcome without = tamp_with("run " + fast + " --set /time/redos=0 --out " + rescued.string());

  CHECK(with.exit_code == 0);
  CHECK(summary_of(redone)["steps"] == 40);
  CHECK(without.exit_code == 3);
  CHECK_THAT(without.err, Catch::Contains("particle ") && Catch::Contains("of material 'sand' at (") &&
                              Catch::Contains("to go on from step 0: ") &&
                              Catch::Contains("--set /time/multiplier=0.5"));
  CHECK(summary_of(rescued)["status"] == "unstable");

  const Outcome restarted = tamp_with("run " + fast + " --restart " + rescued.string());

  CHECK(restarted.exit_code == 0);
  CHECK(summary_of(rescued)["state_digest"] == summary_of(redone)["state_digest"]);
}

}  // namespace test_redone_steps
