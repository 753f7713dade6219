#include "tools/scene/output_file.hpp"

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

TEST_CASE("an output that is one of the inputs, under any of its names, is refused, and the input is left as it was")
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
        Output{drive + " --summary ", own_path.string()}}) {
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

}  // namespace test_output_file
