#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/tools/background_program.hpp"
#include "tests/tools/program.hpp"

using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

/// The quick punch, with the transfer that has particles keep most.
const std::string scene = TAMP_SOURCE_DIR "/inputs/punch/quick.json --set /transfer=affine";

std::string run_of(const fs::path& folder, const std::string& options)
{
  return "run " + scene + " --quiet --out " + folder.string() + " " + options;
}

std::string restart_of(const fs::path& folder, const std::string& options)
{
  return "run " + scene + " --quiet --restart " + folder.string() + " " + options;
}

nlohmann::json summary_of(const fs::path& folder)
{
  return nlohmann::json::parse(std::ifstream(folder / "summary.json"));
}

/// Waits for the first whole checkpoint of a run, as long as a slow machine may need.
bool keeps_its_state(const fs::path& run)
{
  for (int n = 0; n < 6000; ++n) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(run / "checkpoints", none)) {
      if (entry.path().extension() == ".h5") return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// A straight run of 150 steps, made once.
struct Straight {
  TemporaryFolder folder;
  std::string digest;
  std::string history;

  Straight()
  {
    REQUIRE(tamp_with(run_of(folder.path() / "run", "--steps 150")).exit_code == 0);
    digest = summary_of(folder.path() / "run")["state_digest"];
    history = read_text(folder.path() / "run/history.csv");
  }
};

const Straight& straight()
{
  static const Straight run;
  return run;
}

void flip_a_byte(const fs::path& file)
{
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  const auto middle = static_cast<std::streamoff>(fs::file_size(file) / 2);
  stream.seekg(middle);
  const int byte = stream.get();
  stream.seekp(middle);
  stream.put(static_cast<char>(byte ^ 0x40));
}

}  // namespace

TEST_CASE("a run that goes on, on other ranks and threads, ends with the bits of a straight one", "[mpiexec]")
{
  struct Crew {
    int ranks;
    int threads;
  };
  const auto [before, after] = GENERATE(std::pair{Crew{1, 2}, Crew{1, 1}}, std::pair{Crew{1, 1}, Crew{3, 2}},
                                        std::pair{Crew{2, 2}, Crew{1, 3}}, std::pair{Crew{4, 1}, Crew{2, 1}});
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const auto threads = [](const Crew& crew) { return " --threads " + std::to_string(crew.threads); };

  REQUIRE(tamp_on_ranks(before.ranks, run_of(run, "--steps 110 --checkpoint-steps 40" + threads(before))).exit_code ==
          0);
  REQUIRE(tamp_on_ranks(after.ranks, restart_of(run, "--steps 150" + threads(after))).exit_code == 0);

  const auto summary = summary_of(run);
  CHECK(summary["restarted_at_step"] == 80);
  CHECK(summary["ranks"] == after.ranks);
  CHECK(summary["state_digest"] == straight().digest);
  CHECK(read_text(run / "history.csv") == straight().history);
}

TEST_CASE("a damaged checkpoint is refused with its reason, and the one before is used")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  REQUIRE(tamp_with(run_of(run, "--steps 100 --checkpoint-steps 40")).exit_code == 0);
  flip_a_byte(run / "checkpoints/step_00000080.h5");

  const Outcome outcome = tamp_with(restart_of(run, "--steps 150"));

  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Catch::Contains("step_00000080.h5") && Catch::Contains("checksum"));
  CHECK(fs::exists(run / "checkpoints/step_00000080.h5.damaged"));
  CHECK(summary_of(run)["restarted_at_step"] == 40);
  CHECK(summary_of(run)["state_digest"] == straight().digest);
}

TEST_CASE("a folder without a whole checkpoint, or of another scene, cannot be gone on with")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const Outcome nothing = tamp_with(restart_of(run, ""));
  CHECK(nothing.exit_code == 2);
  CHECK_THAT(nothing.err, Catch::Contains("checkpoints: no whole checkpoint"));

  REQUIRE(tamp_with(run_of(run, "--steps 20 --checkpoint-steps 20")).exit_code == 0);
  const Outcome other = tamp_with(restart_of(run, "--set /gravity=[0,-1]"));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Catch::Contains("a checkpoint of another scene"));
  CHECK(tamp_with(restart_of(run, "--steps 30 --set /time/end=6e-3")).exit_code == 0);
}

TEST_CASE("a run that is restarted at its end ends again as it did")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  const std::string end = "--until 2e-4 --checkpoint-time 1e-4";
  REQUIRE(tamp_with(run_of(run, end)).exit_code == 0);
  const auto before = summary_of(run);
  const std::string history = read_text(run / "history.csv");

  CHECK(tamp_with(restart_of(run, end)).exit_code == 0);

  const auto after = summary_of(run);
  CHECK(after["restarted_at_step"] == before["steps"]);
  CHECK(after["state_digest"] == before["state_digest"]);
  CHECK(after["energies_J"] == before["energies_J"]);
  CHECK(read_text(run / "history.csv") == history);
}

TEST_CASE("SIGTERM and SIGINT have a run keep its state and leave with 128 and their number")
{
  const int signal = GENERATE(SIGTERM, SIGINT);
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  BackgroundProgram program(TAMP_PROGRAM, run_of(run, "--checkpoint-steps 5 --threads 1"));
  REQUIRE(keeps_its_state(run));

  program.send(signal);

  CHECK(program.exit_code() == 128 + signal);
  const auto summary = summary_of(run);
  CHECK(summary["status"] == "interrupted");
  REQUIRE(tamp_with(restart_of(run, "--steps " + std::to_string(summary["steps"].get<long>() + 1))).exit_code == 0);
  CHECK(summary_of(run)["restarted_at_step"] == summary["steps"]);
}

TEST_CASE("SIGUSR2, which mpiexec hands on, stops a run on ranks with its state kept", "[mpiexec]")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  allow_ranks_anywhere();
  BackgroundProgram program(TAMP_MPIEXEC, "-n 2 " TAMP_PROGRAM " " + run_of(run, "--checkpoint-steps 5 --threads 1"));
  REQUIRE(keeps_its_state(run));

  program.send(SIGUSR2);

  CHECK(program.exit_code() == 128 + SIGTERM);
  const auto summary = summary_of(run);
  CHECK(summary["status"] == "interrupted");
  REQUIRE(tamp_with(restart_of(run, "--steps " + std::to_string(summary["steps"].get<long>() + 1))).exit_code == 0);
  CHECK(summary_of(run)["restarted_at_step"] == summary["steps"]);
}

TEST_CASE("when one rank is killed all are gone within ten seconds, and the run can be gone on with", "[mpiexec]")
{
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  allow_ranks_anywhere();
  BackgroundProgram program(TAMP_MPIEXEC, "-n 3 " TAMP_PROGRAM " " + run_of(run, "--checkpoint-steps 10 --threads 1"));
  REQUIRE(keeps_its_state(run));
  const std::vector<pid_t> ranks = program.children();
  REQUIRE(ranks.size() == 3);

  kill(ranks[1], SIGKILL);
  const auto killed = std::chrono::steady_clock::now();
  CHECK(program.exit_code() != 0);

  const auto all_gone = [&] { return std::none_of(ranks.begin(), ranks.end(), is_running); };
  while (!all_gone() && std::chrono::steady_clock::now() - killed < std::chrono::seconds(10)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(all_gone());
  CHECK(tamp_with(restart_of(run, "--steps 150")).exit_code == 0);
  CHECK(summary_of(run)["state_digest"] == straight().digest);
}
