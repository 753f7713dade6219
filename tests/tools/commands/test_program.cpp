#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_program
{

using namespace tamp::test;

TEST_CASE("the version names the build, the compiler and every library")
{
  const Outcome outcome = tamp_with("--version");

  CHECK(outcome.exit_code == 0);
  for (const char* name :
       {"tamp ", "build", "compiler", "oneTBB", "Eigen", "HDF5", "MPI", "fmt", "json", "CLI11", "xxHash"}) {
    CHECK_THAT(outcome.out, Catch::Contains(name));
  }
}

TEST_CASE("a command line that cannot be understood ends with 2 and says so on stderr")
{
  for (const char* arguments : {"", "fly", "check", "check a.json --no-such-option", "check a.json b.json"}) {
    const Outcome outcome = tamp_with(arguments);
    INFO(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::StartsWith("tamp: "));
  }
}

TEST_CASE("a number out of its range is refused with the range in words")
{
  const std::vector<std::array<std::string, 2>> all{
      {"verify --jobs 0", "--jobs: 0; expected a whole number, at least 1"},
      {"run a.json --threads 1.5", "--threads: 1.5; expected a whole number, 1 to 1024"},
      {"run a.json --checkpoint-keep 1.5", "--checkpoint-keep: 1.5; expected a whole number, 1 to 1000"},
      {"compare a.json --threads 1e1", "--threads: 1e1; expected a whole number, 1 to 1024"},
      {"graph a.json --ranks 1.5", "--ranks: 1.5; expected a whole number, 1 to 1024"},
      {"graph a.json --threads 1.5", "--threads: 1.5; expected a whole number, 1 to 1024"},
      {"drive a.json b.csv --repeat 1.5", "--repeat: 1.5; expected a whole number, 1 to 1000"},
      {"bench peers --particles 99.5", "--particles: 99.5; expected a whole number, 64 to 100000000"},
      {"bench tasks --message-bytes 16.5", "--message-bytes: 16.5; expected a whole number, 8 to 1048576"},
      {"run a.json --steps 0", "--steps: 0; expected a whole number, at least 1"},
      {"run a.json --steps 99999999999999999999", "--steps: 99999999999999999999; expected a whole number, at least 1"},
      {"run a.json --trace-steps some",
       "--trace-steps: some; expected a whole number, at least 0, or FIRST:LAST, slowest or none"},
      {"run a.json --trace-steps ''",
       "--trace-steps: nothing; expected a whole number, at least 0, or FIRST:LAST, slowest or none"},
      {"run a.json --trace-steps -1",
       "--trace-steps: -1; expected a whole number, at least 0, or FIRST:LAST, slowest or none"},
      {"run a.json --trace-steps 1.5",
       "--trace-steps: 1.5; expected a whole number, at least 0, or FIRST:LAST, slowest or none"},
      {"run a.json --trace-steps 99999999999999999999",
       "--trace-steps: 99999999999999999999; expected a whole number, at least 0, or FIRST:LAST, slowest or none"},
      {"run a.json --trace-steps 110:100",
       "--trace-steps: 110:100; expected FIRST:LAST, whole numbers, from step 1 on and not downwards"},
      {"run a.json --trace-steps 0:5",
       "--trace-steps: 0:5; expected FIRST:LAST, whole numbers, from step 1 on and not downwards"},
      {"run a.json --trace-steps :",
       "--trace-steps: :; expected FIRST:LAST, whole numbers, from step 1 on and not downwards"},
      {"run a.json --trace-steps 5:",
       "--trace-steps: 5:; expected FIRST:LAST, whole numbers, from step 1 on and not downwards"},
      {"run a.json --trace-steps 1:2:3",
       "--trace-steps: 1:2:3; expected FIRST:LAST, whole numbers, from step 1 on and not downwards"},
      {"run a.json --trace-steps -3:-1",
       "--trace-steps: -3:-1; expected FIRST:LAST, whole numbers, from step 1 on and not downwards"},
      {"run a.json --trace-steps 1:99999999999999999999",
       "--trace-steps: 1:99999999999999999999; expected FIRST:LAST, whole numbers, from step 1 on and not downwards"},
      {"run a.json --restart ''", "--restart: nothing; expected a name"},
      {"run a.json --out ''", "--out: nothing; expected a name"},
      {"run a.json --steps -3", "--steps: -3; expected a whole number, at least 1"},
      {"run a.json --threads 0", "--threads: 0; expected 1 to 1024"},
      {"run a.json --until nan", "--until: nan; expected above 0"},
      {"run a.json --wall-limit inf", "--wall-limit: inf; expected above 0"},
      {"run a.json --balance -1", "--balance: -1; expected a whole number, at least 0"},
      {"graph a.json --patch x", "--patch: x; expected a whole number, at least 0"},
      {"drive a.json b.csv --increment 1", "--increment: 1; expected 1e-09 to 0.1"},
      {"bench tasks --message-bytes 1e7", "--message-bytes: 1e7; expected 8 to 1048576"}};
  for (const auto& [arguments, said] : all) {
    const Outcome outcome = tamp_with(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err == "tamp: " + said + "\n");
  }
}

TEST_CASE("help is given for the program and for its commands")
{
  CHECK(tamp_with("--help").exit_code == 0);
  CHECK_THAT(tamp_with("check --help").out, Catch::Contains("--set"));
  CHECK_THAT(tamp_with("help check").out, Catch::Contains("--set"));
}

TEST_CASE("help of what is no command ends with 2 and names the word")
{
  const std::vector<std::array<std::string, 2>> all{{"help run x", "x: no command of run; expected none"},
                                                    {"help run run", "run: no command of run; expected none"},
                                                    {"help chekc", "chekc: no command of tamp; did you mean check?"}};
  for (const auto& [arguments, said] : all) {
    const Outcome outcome = tamp_with(arguments);
    INFO(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::StartsWith("tamp: " + said));
  }
}

TEST_CASE("a command that no ranks share is the first rank's alone", "[mpiexec]")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const Outcome sound = tamp_on_ranks(3, "check " + file.string());
  const Outcome bad = tamp_on_ranks(3, "check " + file.string() + " --set /time/end=0");

  CHECK(sound.exit_code == 0);
  CHECK(sound.err.find("block: 4 particles") == sound.err.rfind("block: 4 particles"));
  CHECK(bad.exit_code == 2);
  CHECK_THAT(bad.err, Catch::Contains("tamp: --set#/time/end: 0; expected a number above 0 [s]"));
  CHECK(tamp_on_ranks(2, "--version").exit_code == 0);
}

TEST_CASE("ranks with different arguments are reported, and do not wait for each other", "[mpiexec]")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);
  allow_ranks_anywhere();
  const std::string program = " -n 1 " TAMP_PROGRAM " ", run = program + "run " + file.string() + " --quiet --out ";
  const std::string here = (folder.path() / "here").string(), there = (folder.path() / "there").string();

  for (const std::string& other : {run + there, run + here + " --steps 2", program + "check " + file.string()}) {
    INFO(other);
    const Outcome outcome = outcome_of(fmt::format("timeout 60 {}{}{} :{}", TAMP_MPIEXEC, run, here, other));
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("rank 1: other arguments than those of rank 0"));
    CHECK_FALSE(std::filesystem::exists(here));
  }
}

TEST_CASE("volume and mass of a solid are printed beside those of its particles")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  // A disk of radius 1 m holds 12 sites of its 16 squares of 0.5 m: 3 m2 of pi.
  const Outcome disk = tamp_with("check " + file.string() +
                                 " --set '/bodies/block/geometry={\"type\":\"ball\",\"centre\":[1,1],\"radius\":1}'");

  CHECK_THAT(disk.err, Catch::Contains("solid      3.14159 m3, 25132.7 kg (exact)"));
  CHECK_THAT(disk.err, Catch::Contains("particles  3 m3, 24000 kg (-4.51 %)"));
}

TEST_CASE("a sound scene passes the check, is printed resolved, and its particles are counted")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const Outcome outcome = tamp_with("check " + file.string());

  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Catch::Contains("\"rule\": \"viscous\""));
  CHECK_THAT(outcome.err, Catch::Contains("block: 4 particles of steel") && Catch::Contains("MiB"));
}

TEST_CASE("each problem of a bad scene is a line of its own on stderr, and the exit code is 2")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const Outcome outcome = tamp_with("check " + file.string() + " --set /time/end=0 --set /gravity=down");

  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err ==
        "tamp: --set#/time/end: 0; expected a number above 0 [s]\n"
        "tamp: --set#/gravity: \"down\"; expected 2 numbers\n");
}

TEST_CASE("a scene file that is not there ends with 2")
{
  const Outcome outcome = tamp_with("check /no/such/scene.json");

  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err == "tamp: /no/such/scene.json: no such file; expected the name of one\n");
}

}  // namespace test_program
