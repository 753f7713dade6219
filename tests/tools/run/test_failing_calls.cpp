#ifdef TAMP_FAILING_CALLS  // not with a sanitizer
#  include <catch2/catch.hpp>
#  include <chrono>
#  include <csignal>
#  include <nlohmann/json.hpp>
#  include <thread>

#  include "tests/tools/background_program.hpp"
#  include "tests/tools/program.hpp"

namespace test_failing_calls
{

/// A refused system call ends a run with 4 and the place, and the checkpoint before it restarts.
using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

/// A call that fails, see tests/faults/failing_calls.cpp, and what the message names.
struct Fault {
  std::string call;
  int at = 1;
  std::string path;
  std::string message;
  std::string size = "0";
};

std::ostream& operator<<(std::ostream& stream, const Fault& fault)
{
  return stream << fault.call << " number " << fault.at << " " << fault.path;
}

const std::string run = TAMP_PROGRAM " run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --quiet --threads 2 ";
const std::string outputs =
    "--set /output/fields_interval=2e-5 --set /output/history_interval=1e-5 --checkpoint-steps 5 --checkpoint-keep 10 ";

nlohmann::json summary_of(const fs::path& folder)
{
  return nlohmann::json::parse(read_text(folder / "summary.json"));
}

std::string digest_of(const fs::path& folder)
{
  return summary_of(folder)["state_digest"];
}

/// A disk on which a checkpoint takes at least 0.8 s: the file's fsync, and its folder's.
const std::string slow_disk = "LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_SLOW_FSYNC=400 ";

std::string straight_digest()
{
  static const std::string digest = [] {
    const TemporaryFolder folder;
    REQUIRE(outcome_of(run + outputs + "--steps 20 --out " + (folder.path() / "run").string()).exit_code == 0);
    return digest_of(folder.path() / "run");
  }();
  return digest;
}

}  // namespace

TEST_CASE("a call that fails ends a run with 4 and the place, and its last checkpoint restarts", "[slow]")
{
  const Fault fault = GENERATE(
      Fault{"fwrite", 2, "history.csv", "history.csv: No space left"}, Fault{"fflush", 2, "history.csv", "history.csv"},
      Fault{"fwrite", 2, "fields.xdmf", "fields.xdmf"}, Fault{"rename", 2, "fields.xdmf", "fields.xdmf: Permission"},
      Fault{"rename", 2, "checkpoints", "checkpoints/step_"}, Fault{"fsync", 3, "checkpoints", "checkpoints"},
      Fault{"fallocate", 2, "fields.h5", "fields.h5: No space left"}, Fault{"pwrite", 100, "fields.h5", "fields.h5"},
      Fault{"pwrite", 2, "checkpoints", "checkpoints/step_"}, Fault{"pwrite", 5, "checkpoints", "checkpoints/step_"},
      Fault{"pwrite", 6, "checkpoints", "checkpoints/step_"}, Fault{"pwrite", 10, "checkpoints", "checkpoints/step_"},
      Fault{"pwrite", 30, "checkpoints", "checkpoints/step_"}, Fault{"H5Dwrite", 70, "", ".h5"},
      Fault{"H5Fclose", 1, "", ".h5"}, Fault{"H5Dcreate2", 60, "", ".h5"}, Fault{"H5Dclose", 60, "", ".h5"},
      Fault{"fwrite", 1, "summary.json", "summary.json"}, Fault{"rename", 1, "profile.json", "profile.json"},
      // More than HDF5 asks for, which tries again without a word.
      Fault{"malloc", 1, "", "memory", "600000"});
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";
  const std::string failing = "LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_FAIL_CALL=" + fault.call +
                              " TAMP_FAIL_AT=" + std::to_string(fault.at) + " TAMP_FAIL_PATH=" + fault.path +
                              " TAMP_FAIL_SIZE=" + fault.size +
                              " TAMP_FAIL_WHEN=" + (out / "checkpoints/step_00000005.h5").string() + " ";

  const Outcome outcome = outcome_of(failing + run + outputs + "--steps 20 --out " + out.string());
  INFO(fault << ": " << outcome.err);

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::StartsWith("tamp: ") && Catch::Contains(fault.message));
  if (fault.call != "malloc") CHECK_NOTHROW(summary_of(out).at("state_digest"));
  REQUIRE(outcome_of(run + outputs + "--steps 20 --restart " + out.string()).exit_code == 0);
  CHECK(digest_of(out) == straight_digest());
}

TEST_CASE("memory that runs out before main ends a program with 4")
{
  const int at = GENERATE(1, 20, 200);

  const Outcome outcome =
      outcome_of("LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_FAIL_CALL=new TAMP_FAIL_AT=" + std::to_string(at) +
                 " " TAMP_PROGRAM " version");

  CHECK(outcome.exit_code == 4);
  CHECK(outcome.err == "tamp: out of memory\n");
}

TEST_CASE("fields that cannot be begun leave no file under their name")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";

  const Outcome outcome =
      outcome_of("LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_FAIL_CALL=pwrite TAMP_FAIL_AT=1 TAMP_FAIL_PATH=fields.h5 " +
                 run + "--steps 1 --out " + out.string());

  CHECK(outcome.exit_code == 4);
  CHECK_FALSE(fs::exists(out / "fields.h5"));
}

TEST_CASE("a run that cannot write its trace has its summary and its profile")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";

  const Outcome outcome =
      outcome_of("LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_FAIL_CALL=rename TAMP_FAIL_AT=1 TAMP_FAIL_PATH=trace.json " +
                 run + "--steps 5 --out " + out.string());

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains("trace.json"));
  CHECK(summary_of(out)["status"] == "completed");
  CHECK(fs::exists(out / "profile.json"));
  CHECK_FALSE(fs::exists(out / "trace.json"));
}

TEST_CASE("a thread that cannot be started ends a run with 4 before it begins")
{
  const int at = GENERATE(range(1, 6));
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";

  const Outcome outcome =
      outcome_of("LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_FAIL_CALL=pthread_create TAMP_FAIL_AT=" + std::to_string(at) +
                 " TAMP_FAIL_WHEN=" + out.string() + " " + run + "--steps 2 --out " + out.string());
  INFO(at << ": " << outcome.err);

  // Fewer threads may be started than this number.
  CHECK((outcome.exit_code == 4 || outcome.exit_code == 0));
  CHECK((outcome.exit_code == 0 || outcome.err.find("thread") != std::string::npos));
  if (at == 1) CHECK(outcome.exit_code == 4);
}

TEST_CASE("a run goes on while a checkpoint is written, and waits for it in the end", "[mpiexec]")
{
  const int n_ranks = GENERATE(1, 2);
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";
  allow_ranks_anywhere();
  const std::string launcher = n_ranks == 1 ? "" : TAMP_MPIEXEC " -n 2 ";

  const Outcome outcome =
      outcome_of(slow_disk + launcher + run + "--steps 10 --checkpoint-steps 4 --out " + out.string());

  REQUIRE(outcome.exit_code == 0);
  const auto output = summary_of(out)["output"];
  CHECK(output["in_background"] == true);
  // The checkpoint of step 8 waits for that of step 4, and the end for both.
  CHECK(output["waited_s"] > 1.2);
  CHECK(output["checkpoints_s"] < 0.8);
  CHECK(fs::exists(out / "checkpoints/step_00000004.h5"));
  CHECK(fs::exists(out / "checkpoints/step_00000008.h5"));
}

TEST_CASE("a signal that comes while a checkpoint is written leaves that one and its own", "[slow]")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run", part = out / "checkpoints/step_00000005.h5.part";
  BackgroundProgram program("/usr/bin/env", slow_disk + run + outputs + "--out " + out.string());
  for (int n = 0; n < 6000 && !fs::exists(part); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  REQUIRE(fs::exists(part));

  program.send(SIGTERM);

  CHECK(program.exit_code() == 128 + SIGTERM);
  const auto summary = summary_of(out);
  const long steps = summary["steps"];
  CHECK(summary["status"] == "interrupted");
  CHECK(fs::exists(out / "checkpoints/step_00000005.h5"));
  REQUIRE(outcome_of(run + outputs + "--steps " + std::to_string(steps + 1) + " --restart " + out.string()).exit_code ==
          0);
  CHECK(summary_of(out)["restarted_at_step"] == steps);
}

TEST_CASE("what cannot be written in the background ends a run before its next output")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";

  const Outcome outcome = outcome_of(
      "LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_FAIL_CALL=fsync TAMP_FAIL_AT=1 TAMP_FAIL_PATH=checkpoints " + run +
      "--checkpoint-steps 5 --set /output/fields_interval=1 --set /output/history_interval=1 --out " + out.string());

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains("step_00000005.h5") && Catch::Contains("No space left on device"));
  CHECK(fs::is_empty(out / "checkpoints"));
}

}  // namespace test_failing_calls

#endif
