#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_full_disk
{

using namespace tamp::test;

namespace
{

std::string digest_of(const std::filesystem::path& run)
{
  return nlohmann::json::parse(read_text(run / "summary.json"))["state_digest"];
}

}  // namespace

TEST_CASE("a disk that fills while a checkpoint is written ends the run with 4, and the one before still restarts",
          "[mpiexec]")
{
  const int n_ranks = GENERATE(1, 2);
  const TemporaryFolder folder;
  const std::string disk = folder.path().string() + "/disk", kept = folder.path().string() + "/kept";
  // Room for the first fields (0.7 MB) and two checkpoints (0.7 MB each): the third finds the disk full.
  const std::string mount = "mkdir -p " + disk + " && mount -t tmpfs -o size=2500k tmpfs " + disk;
  const auto as_root = [](const std::string& script) {
    return outcome_of("unshare --map-root-user --mount sh -c '" + script + "'");
  };
  if (as_root(mount).exit_code != 0) {
    WARN("no disk of a given size can be made here: not tested");
    return;
  }
  allow_ranks_anywhere();
  const std::string launcher = n_ranks == 1 ? "" : TAMP_MPIEXEC " -n 2 ";
  const std::string run = TAMP_PROGRAM " run " TAMP_SOURCE_DIR
                                       "/inputs/punch/quick.json --quiet --threads 1 --set /output/fields_interval=1 ";

  const Outcome full = as_root(mount + "; " + launcher + run + "--checkpoint-steps 25 --out " + disk +
                               "/run; code=$?; cp -r " + disk + "/run " + kept + "; exit $code");
  const Outcome restarted = outcome_of(std::string(run) + "--steps 150 --restart " + kept);

  CHECK(full.exit_code == 4);
  CHECK_THAT(full.err, Catch::Contains("tamp: ") && Catch::Contains("checkpoints/step_") &&
                           Catch::Contains("No space left on device"));
  REQUIRE(restarted.exit_code == 0);
  REQUIRE(outcome_of(run + "--steps 150 --out " + folder.path().string() + "/straight").exit_code == 0);
  CHECK(digest_of(kept) == digest_of(folder.path() / "straight"));
}

TEST_CASE("a run whose disk is full leaves a summary that says so, whatever finds it full", "[slow]")
{
  // Room for the first fields (0.7 MB). What follows are fields, or checkpoints, or rows to the last byte.
  const auto [options, name] = GENERATE(table<std::string, std::string>(
      {{"--set /output/fields_interval=1e-6", "fields.h5"},
       {"--set /output/fields_interval=1 --checkpoint-steps 5", "checkpoints/step_"},
       {"--set /output/fields_interval=1 --set /output/history_interval=1e-9", ".csv"}}));
  const TemporaryFolder folder;
  const std::string disk = folder.path().string() + "/disk", kept = folder.path().string() + "/kept";
  const std::string mount = "mkdir -p " + disk + " && mount -t tmpfs -o size=1600k tmpfs " + disk;
  const auto as_root = [](const std::string& script) {
    return outcome_of("unshare --map-root-user --mount sh -c '" + script + "'");
  };
  if (as_root(mount).exit_code != 0) {
    WARN("no disk of a given size can be made here: not tested");
    return;
  }

  const Outcome full = as_root(
      mount +
      "; " TAMP_PROGRAM " run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --quiet --threads 1 --trace-steps none " +
      options + " --out " + disk + "/run; code=$?; cp -r " + disk + "/run " + kept + "; exit $code");

  INFO(options << "\n" << full.err);
  CHECK(full.exit_code == 4);
  CHECK_THAT(full.err, Catch::Contains(name) && Catch::Contains("No space left on device"));
  const auto summary = nlohmann::json::parse(read_text(kept + "/summary.json"));
  CHECK(summary["status"] == "interrupted");
  CHECK_THAT(summary["reason"].get<std::string>(), Catch::Contains(name));
  CHECK_FALSE(std::filesystem::exists(kept + "/summary.json.part"));
}

TEST_CASE("a run whose files may grow no more leaves a summary that says so", "[mpiexec]")
{
  const int n_ranks = GENERATE(1, 2);
  const TemporaryFolder folder;
  allow_ranks_anywhere();
  const std::string launcher = n_ranks == 1 ? "" : TAMP_MPIEXEC " -n 2 ";

  // Blocks of 512 bytes.
  const Outcome outcome = outcome_of(launcher +
                                     "sh -c 'ulimit -f 200; exec " TAMP_PROGRAM " run " TAMP_SOURCE_DIR
                                     "/inputs/punch/quick.json --quiet --threads 1 --steps 20 --out " +
                                     folder.path().string() + "/run'");

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains("fields.h5: File too large"));
  CHECK(nlohmann::json::parse(read_text(folder.path() / "run/summary.json"))["status"] == "interrupted");
}

}  // namespace test_full_disk
