#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "tests/tools/program.hpp"

namespace test_pipes
{

/// Where a file of a run should be there is a pipe, which a program that opens it waits for, and hears no signal.
using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

const std::string scene = TAMP_SOURCE_DIR "/inputs/punch/quick.json ";

/// A minute is more than enough; 137 is the exit code of one that had to be killed.
Outcome tamp_in_a_minute(const std::string& arguments)
{
  return outcome_of("timeout --signal=KILL 60 " TAMP_PROGRAM " " + arguments);
}

/// A run of four steps with a checkpoint, made once.
const fs::path& run_of_four_steps()
{
  static const TemporaryFolder folder;
  static const fs::path run = [] {
    fs::path made = folder.path() / "run";
    REQUIRE(tamp_with("run " + scene + "--quiet --steps 4 --checkpoint-steps 2 --out " + made.string()).exit_code == 0);
    return made;
  }();
  return run;
}

void put_pipe(const fs::path& file)
{
  fs::remove(file);
  REQUIRE(mkfifo(file.c_str(), 0600) == 0);
}

}  // namespace

TEST_CASE("a run does not go on where a pipe stands for one of its files, and names it", "[slow]")
{
  const std::string name = GENERATE("history.csv", "machine.csv", "fields.h5", "fields.xdmf", "summary.json",
                                    "profile.json", "trace.json", "scene.json", "summary.json.part", ".tamp-run");
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  fs::copy(run_of_four_steps(), run, fs::copy_options::recursive);
  put_pipe(run / name);

  const Outcome outcome = tamp_in_a_minute("run " + scene + "--quiet --steps 6 --restart " + run.string());

  INFO(name);
  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains(name + ": a pipe, a device or a socket; expected a file"));
  CHECK(fs::is_fifo(run / name));
}

TEST_CASE("a pipe that stands for the newest checkpoint is passed over, and refused where there is no other")
{
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  fs::copy(run_of_four_steps(), run, fs::copy_options::recursive);
  const std::string restart = "run " + scene + "--quiet --steps 6 --restart " + run.string();
  put_pipe(run / "checkpoints/step_00000002.h5");
  put_pipe(run / "checkpoints/step_00000004.h5");

  const Outcome outcome = tamp_in_a_minute(restart);

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains("step_00000004.h5: a pipe, a device or a socket; expected a file"));

  fs::remove(run / "checkpoints/step_00000002.h5");
  fs::copy(run_of_four_steps() / "checkpoints/step_00000002.h5", run / "checkpoints");
  CHECK(tamp_in_a_minute(restart).exit_code == 0);
}

TEST_CASE("a pipe that comes to stand for a file of a run while it goes on ends it with 4", "[slow]")
{
  const std::string name = GENERATE("fields.h5", "fields.xdmf", "summary.json");
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string(), file = run + "/" + name;

  const Outcome outcome =
      outcome_of("sh -c 'timeout --signal=KILL 60 " TAMP_PROGRAM " run " + scene +
                 "--quiet --steps 3000 --set /output/fields_interval=1e-5 --set /output/history_interval=1e-5 --out " +
                 run + " & run=$!; while [ $(cat " + run +
                 "/history.csv 2>/dev/null | wc -l) -lt 3 ]; do sleep 0.01; done; "
                 // A pipe that comes between the look at a file and its replacement is replaced.
                 "for i in 1 2 3 4 5 6 7 8 9; do kill -0 $run 2>/dev/null || break; mkfifo " +
                 run + "/pipe; mv -f " + run + "/pipe " + file + "; sleep 0.2; done; wait $run'");

  INFO(name);
  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains(name + ": a pipe, a device or a socket; expected a file"));
}

TEST_CASE("a page is not drawn from a pipe or into one", "[slow]")
{
  const std::string name = GENERATE("fields.h5", "report.html", "page.json", "summary.json", "profile.json");
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  fs::copy(run_of_four_steps(), run, fs::copy_options::recursive);
  put_pipe(run / name);

  const Outcome outcome = tamp_in_a_minute("profile --format html " + run.string());

  INFO(name);
  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains(name));
}

}  // namespace test_pipes
