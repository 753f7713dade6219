#include <catch2/catch.hpp>

#include "tests/tools/program.hpp"

namespace test_profile_command
{

using namespace tamp::test;

TEST_CASE("a profile that is damaged is reported with the key that it lacks")
{
  const TemporaryFolder folder;
  const std::string file = folder.write("profile.json", "{}").string();
  const std::string command = "profile " + folder.path().string();

  const Outcome empty = tamp_with(command);
  folder.write("profile.json", R"({"tasks": [3]})");
  const Outcome odd = tamp_with(command);

  CHECK(empty.exit_code == 4);
  CHECK(empty.err == "tamp: " + file + ": is damaged: the key \"tasks\" is missing; expected what a run has written\n");
  CHECK(odd.exit_code == 4);
  CHECK(odd.err ==
        "tamp: " + file + ": is damaged: a value is not what it was written as; expected what a run has written\n");
}

TEST_CASE("the page of a run says how it ended, how far to trust it, and where its time went")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 60 --quiet --out " + out).exit_code == 0);

  const Outcome drawn = tamp_with("profile " + out + " --format html");

  CHECK(drawn.exit_code == 0);
  CHECK(drawn.out == "written to " + out + "/report.html\n");
  const std::string page = read_text(out + "/report.html");
  for (const char* words : {"after 60 steps", "energy drift", "Force on punch against its depth", "Step size",
                            "update stress: sand", "What workers waited for", "cap state"}) {
    CHECK_THAT(page, Catch::Contains(words));
  }
  CHECK_THAT(page, !Catch::Contains("http://") || Catch::Contains("http://www.w3.org"));
  CHECK_THAT(page, !Catch::Contains("https://"));
}

}  // namespace test_profile_command
