#ifdef TAMP_FAILING_CALLS  // not with a sanitizer
#  include <catch2/catch.hpp>
#  include <nlohmann/json.hpp>

#  include "tests/tools/program.hpp"

/// What the system refuses ends a run with 4 and the place, and the checkpoint before it restarts.
using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

/// One call that fails, see tests/faults/failing_calls.cpp, and what the message names.
struct Fault {
  std::string call;
  int at = 1;
  std::string path;
  std::string told;
  std::string size = "0";
};

std::ostream& operator<<(std::ostream& stream, const Fault& fault)
{
  return stream << fault.call << " number " << fault.at << " " << fault.path;
}

const std::string run = TAMP_PROGRAM " run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --quiet --threads 2 ";
const std::string outputs =
    "--set /output/fields_interval=2e-5 --set /output/history_interval=1e-5 --checkpoint-steps 5 --checkpoint-keep 10 ";

std::string digest_of(const fs::path& folder)
{
  return nlohmann::json::parse(read_text(folder / "summary.json"))["state_digest"];
}

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

TEST_CASE("a call that fails ends a run with 4 and the place, and its last checkpoint restarts")
{
  const Fault fault = GENERATE(
      Fault{"fwrite", 4, "history.csv", "history.csv: No space left"}, Fault{"fflush", 4, "history.csv", "history.csv"},
      Fault{"fwrite", 2, "fields.xdmf", "fields.xdmf"}, Fault{"rename", 2, "fields.xdmf", "fields.xdmf: Permission"},
      Fault{"rename", 2, "checkpoints", "checkpoints/step_"}, Fault{"fsync", 3, "checkpoints", "checkpoints"},
      Fault{"fallocate", 2, "fields.h5", "fields.h5: No space left"}, Fault{"pwrite", 100, "fields.h5", "fields.h5"},
      Fault{"pwrite", 2, "checkpoints", "checkpoints/step_"}, Fault{"pwrite", 5, "checkpoints", "checkpoints/step_"},
      Fault{"pwrite", 6, "checkpoints", "checkpoints/step_"}, Fault{"pwrite", 10, "checkpoints", "checkpoints/step_"},
      Fault{"pwrite", 30, "checkpoints", "checkpoints/step_"}, Fault{"H5Dwrite", 70, "", ".h5"},
      Fault{"H5Fclose", 1, "", ".h5"}, Fault{"H5Dcreate2", 60, "", ".h5"},
      Fault{"fwrite", 1, "summary.json", "summary.json"}, Fault{"rename", 1, "profile.json", "profile.json"},
      Fault{"malloc", 2, "", "memory", "50000"});
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";
  const std::string failing = "LD_PRELOAD=" TAMP_FAILING_CALLS " TAMP_FAIL_CALL=" + fault.call +
                              " TAMP_FAIL_AT=" + std::to_string(fault.at) + " TAMP_FAIL_PATH=" + fault.path +
                              " TAMP_FAIL_SIZE=" + fault.size +
                              " TAMP_FAIL_WHEN=" + (out / "checkpoints/step_00000005.h5").string() + " ";

  const Outcome outcome = outcome_of(failing + run + outputs + "--steps 20 --out " + out.string());
  INFO(fault << ": " << outcome.err);

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::StartsWith("tamp: ") && Catch::Contains(fault.told));
  REQUIRE(outcome_of(run + outputs + "--steps 20 --restart " + out.string()).exit_code == 0);
  CHECK(digest_of(out) == straight_digest());
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
#endif
