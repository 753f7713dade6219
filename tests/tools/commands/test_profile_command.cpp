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

}  // namespace test_profile_command
