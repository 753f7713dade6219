#include <catch2/catch.hpp>
#include <regex>

#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_console
{

using namespace tamp::test;

TEST_CASE("a run goes on when nobody listens", "[slow]")
{
  const std::string closed = GENERATE(as<std::string>(), ">&-", ">&- 2>&-", "<&- >&- 2>&-", "| true");
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string(), code = (folder.path() / "code").string();
  const std::string run = TAMP_PROGRAM " run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 3 --out " + out;

  outcome_of("sh -c '{ " + run + "; echo $? >" + code + "; } " + closed + "'");

  CHECK(read_text(code) == "0\n");
  CHECK_THAT(read_text(folder.path() / "run/summary.json"), Catch::Contains("\"steps\": 3"));
  CHECK_THAT(read_text(folder.path() / "run/history.csv"), Catch::StartsWith("step,") && !Catch::Contains("forecast"));
}

TEST_CASE("an error that cannot be told ends a command as one that can")
{
  const TemporaryFolder folder;
  const std::string scene = folder.write("small.json", small_scene).string();

  CHECK(outcome_of("sh -c '" TAMP_PROGRAM " check " + scene + " 2>/dev/full'").exit_code == 0);
  CHECK(outcome_of("sh -c '" TAMP_PROGRAM " check " + scene + " --set /time/end=0 2>/dev/full'").exit_code == 2);
}

TEST_CASE("a command that prints ends quietly when its reader has gone, and with 4 when stdout is full", "[slow]")
{
  const TemporaryFolder folder;
  const std::string scene = folder.write("small.json", small_scene).string(), code = folder.path().string() + "/code";
  const std::string words = GENERATE(as<std::string>(), "check SCENE", "check SCENE --json",
                                     "graph SCENE --format json", "--version", "run --help");
  const std::string command = std::regex_replace(words, std::regex("SCENE"), scene);

  const Outcome gone =
      outcome_of("sh -c '{ sleep 0.2; " TAMP_PROGRAM " " + command + "; echo $? >" + code + "; } | true'");
  const Outcome full = outcome_of("sh -c '" TAMP_PROGRAM " " + command + " >/dev/full'");

  CHECK(read_text(code) == "0\n");
  CHECK_THAT(gone.err, !Catch::Contains("tamp: standard output"));
  CHECK(full.exit_code == 4);
  CHECK_THAT(full.err, Catch::Contains("tamp: standard output: No space left on device"));
}

TEST_CASE("what would steer a terminal is written out in messages")
{
  const TemporaryFolder folder;
  const std::string scene = folder.write("small.json", small_scene).string();
  const std::string table = folder
                                .write("curves.csv",
                                       "a\x1b[2J\x07,\xc2\x9b"
                                       "31m\n1,2\n")
                                .string();

  const Outcome key = tamp_with("check " + scene + " --set '/grid/\x1b[31m=1'");
  const Outcome name = tamp_with("check '" + folder.path().string() + "/\x1b]0;x\x07.json'");
  const Outcome cell = tamp_with("modulus " + table + " --at 0,0");

  for (const Outcome& outcome : {key, name, cell}) {
    CHECK(outcome.exit_code != 0);
    CHECK_THAT(outcome.err, !Catch::Contains("\x1b") && !Catch::Contains("\x07") && !Catch::Contains("\xc2\x9b"));
  }
  CHECK_THAT(key.err, Catch::Contains("\\x1b[31m"));
  CHECK_THAT(name.err, Catch::Contains("/\\x1b]0;x\\x07.json"));
  CHECK_THAT(cell.err, Catch::Contains("columns a\\x1b[2J\\x07,\\x9b31m"));
}

}  // namespace test_console
