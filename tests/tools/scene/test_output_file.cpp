#include "tools/scene/files/output_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <utility>

#include "runtime/file_error.hpp"
#include "tests/tools/program.hpp"

namespace test_output_file
{

/// An output of a command never replaces one of its inputs.
using namespace tamp::test;
namespace fs = std::filesystem;

namespace
{

const std::string sand = TAMP_SOURCE_DIR "/inputs/materials/concrete-sand";
const char* const states = "elastic_volumetric[-],plastic_volumetric[-]\n0.01,0\n";
const char* const path = "time,F11,F12,F13,F21,F22,F23,F31,F32,F33\n0,1,0,0,0,1,0,0,0,1\n1,0.99,0,0,0,1,0,0,0,1\n";

}  // namespace

TEST_CASE("an output that is one of the inputs, under any of its names, is refused, and the input is left as it was",
          "[slow]")
{
  const TemporaryFolder folder;
  fs::copy(sand, folder.path() / "sand");
  const fs::path table = folder.path() / "sand/table.json", own_states = folder.write("states.csv", states),
                 own_path = folder.write("path.csv", path);
  const std::string material = table.string(), before = read_text(table);
  fs::create_hard_link(own_states, folder.path() / "hard.csv");
  fs::create_symlink("path.csv", folder.path() / "soft.csv");
  const auto in = [&](const char* name) { return (folder.path() / name).string(); };
  const std::string modulus = "modulus " + material + " --states " + own_states.string();
  const std::string drive = "drive " + material + " " + own_path.string();

  using Output = std::pair<std::string, std::string>;
  for (const auto& [command, file] :
       {Output{modulus + " --out ", own_states.string()}, Output{modulus + " --out ", in("sand/../states.csv")},
        Output{modulus + " --out ", in("hard.csv")}, Output{modulus + " --out ", material},
        Output{modulus + " --summary ", material}, Output{drive + " --out ", in("soft.csv")},
        Output{drive + " --plot ", own_path.string()}, Output{drive + " --summary ", own_path.string()}}) {
    INFO(command << file);
    const Outcome outcome = tamp_with(command + file);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("one of the files that are read; expected another file"));
  }
  CHECK(read_text(table) == before);
  CHECK(read_text(own_states) == states);
  CHECK(read_text(own_path) == path);
}

TEST_CASE("two outputs are two files")
{
  const TemporaryFolder folder;
  const auto own_states = folder.write("states.csv", states);
  const std::string out = (folder.path() / "out").string();

  const Outcome outcome = tamp_with("modulus " + sand + "/table.json --states " + own_states.string() + " --out " +
                                    out + " --summary " + out);

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Catch::Contains("the file of --summary"));
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("what cannot be written is found before the work")
{
  const TemporaryFolder folder;
  const auto file = folder.write("file", "");
  const auto is_refused = [](const fs::path& out) {
    try {
      tamp::tools::expect_outputs({{"--out", out}});
      return false;
    } catch (const tamp::runtime::FileError&) {
      return true;
    }
  };

  CHECK(is_refused(folder.path() / "nowhere/out.csv"));
  CHECK(is_refused(file / "out.csv"));
  CHECK(is_refused(folder.path()));
  CHECK_FALSE(is_refused(file));
  CHECK_FALSE(is_refused("/dev/null"));
  CHECK_FALSE(is_refused(folder.path() / "out.csv"));
}

TEST_CASE("a device that is written to stays one")
{
  const TemporaryFolder folder;
  const auto own_states = folder.write("states.csv", states);
  const fs::path link = folder.path() / "null";
  fs::create_symlink("/dev/null", link);

  const Outcome outcome =
      tamp_with("modulus " + sand + "/table.json --states " + own_states.string() + " --out " + link.string());

  CHECK(outcome.exit_code == 0);
  CHECK(fs::is_symlink(link));
  CHECK(fs::is_character_file(link));
}

TEST_CASE("what a run has left is not replaced by what is drawn from it", "[slow]")
{
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run", page = run / "report.html";
  const std::string scene = TAMP_SOURCE_DIR "/inputs/punch/quick.json";
  REQUIRE(tamp_with("run " + scene + " --quiet --steps 2 --out " + run.string()).exit_code == 0);
  fs::create_symlink("history.csv", folder.path() / "soft.csv");
  const auto is_refused = [&](const std::string& command, const fs::path& file) {
    const std::string before = read_text(file);
    const Outcome outcome = tamp_with(command);
    INFO(command << "\n" << outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("one of the files that are read; expected another file"));
    CHECK(read_text(file) == before);
  };

  const std::string graph = "graph " + scene + " --run " + run.string();
  is_refused(graph + " --format html --out " + (run / "profile.json").string(), run / "profile.json");
  is_refused(graph + " --format html --out " + (run / "scene.json").string(), run / "scene.json");
  is_refused(graph + " --threads 2 --out " + (run / "profile.json").string(), run / "profile.json");
  fs::create_symlink("profile.json", page);
  is_refused("profile --format html " + run.string(), run / "profile.json");
  fs::remove(page);
  fs::create_hard_link(run / "summary.json", page);
  is_refused("profile --format html " + run.string(), run / "summary.json");
  fs::remove(page);
  fs::create_symlink("history.csv", run / "page.json");
  is_refused("profile --format html " + run.string(), run / "history.csv");
}

TEST_CASE("a list of results is not written over a study, a scene or data that come with the program")
{
  const TemporaryFolder folder;
  fs::copy(TAMP_SOURCE_DIR "/inputs", folder.path() / "inputs", fs::copy_options::recursive);
  const std::string inside = "cd " + folder.path().string() + " && timeout 100 " TAMP_PROGRAM " ";
  const auto [command, file] = GENERATE(
      table<std::string, std::string>({{"verify bar --short --quiet", "inputs/verification/scenes/bar.json"},
                                       {"stability null_space --quiet", "inputs/stability/scenes/null_space.json"},
                                       {"bench moduli", "inputs/materials/concrete-sand/table.json"},
                                       {"bench tasks --threads 1", "inputs/punch/quick.json"}}));
  const std::string before = read_text(folder.path() / file);
  REQUIRE_FALSE(before.empty());

  const Outcome outcome = outcome_of(inside + command + " --json " + file);

  INFO(command);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Catch::Contains("--json " + file + ": one of the files that are read"));
  CHECK(read_text(folder.path() / file) == before);
}

TEST_CASE("a path that cannot be driven to its end leaves no table that looks whole")
{
  const TemporaryFolder folder;
  const auto own_path = folder.write("path.csv", std::string(path) + "2,1e200,0,0,0,1e200,0,0,0,1e200\n");
  const fs::path out = folder.path() / "out.csv";

  const Outcome outcome = tamp_with("drive " + sand + "/table.json " + own_path.string() + " --out " + out.string());

  REQUIRE(outcome.exit_code != 0);
  CHECK_FALSE(fs::exists(out));
}

}  // namespace test_output_file
