#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_program
{

using namespace tamp::test;

namespace
{

const std::string ball = TAMP_SOURCE_DIR "/inputs/ball/quick.json";

/// Without the files that it was read from, which are others once it has been printed.
nlohmann::json scene_of(const std::string& text)
{
  nlohmann::json scene = nlohmann::json::parse(text);
  scene.erase("inputs");
  return scene;
}

}  // namespace

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

TEST_CASE("a number out of its range is refused with the range in words", "[slow]")
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
  CHECK_THAT(sound.out, Catch::Contains("block: 4 particles"));
  CHECK(sound.out.find("block: 4 particles") == sound.out.rfind("block: 4 particles"));
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

  CHECK_THAT(disk.out, Catch::Contains("solid      3.14159 m3, 25132.7 kg (exact)"));
  CHECK_THAT(disk.out, Catch::Contains("particles  3 m3, 24000 kg (-4.51 %)"));
}

TEST_CASE("a sound scene passes the check, and what is said of it is no JSON")
{
  const TemporaryFolder folder;
  const auto file = folder.write("small.json", small_scene);

  const Outcome outcome = tamp_with("check " + file.string());

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  CHECK_THAT(outcome.out,
             Catch::StartsWith(file.string() + ": small\n"
                                               "  kind  2 dimensions, plane strain, until 1 s\n"
                                               "  grid  2 x 2 cells of 1 m, 4 in all; 2 x 2 m; 1 x 1 patches\n"
                                               "  particles  4: 4 of steel (hypoelastic)\n"
                                               "  body  block: 4 particles of steel\n"));
  CHECK_THAT(outcome.out, Catch::Contains("\n  forecast: 4 particles, ") && Catch::Contains("MiB"));
  CHECK_THAT(outcome.out, !Catch::Contains("\"rule\"") && !Catch::Contains("{"));
}

TEST_CASE("what the check says of the ball fits on a screen: its scene, bodies, forecast, warnings and advice")
{
  const Outcome outcome = tamp_with("check " + ball);

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  CHECK(std::ranges::count(outcome.out, '\n') <= 40);
  for (const char* line :
       {"quick.json: A steel ball of 20 mm dropped into dry sand", "  kind  2 dimensions, axisymmetric, until 0.03 s\n",
        "  grid  48 x 96 cells of 0.0025 m, 4608 in all; 0.12 x 0.24 m; 1 x 2 patches\n",
        "  particles  11620: 100 of steel (hypoelastic), 11520 of sand (tabular_cap)\n",
        "  body  ball: 100 particles of steel, rigid\n", "  body  sand: 11520 particles of sand\n",
        "tamp: warning: /bodies/ball/geometry: ", "  forecast: 11620 particles, ", " on the disk, about ",
        " core-seconds", "  advice  cells: ball has 4.0 to its half width"}) {
    CHECK_THAT(outcome.out, Catch::Contains(line));
  }
  CHECK_THAT(outcome.out, !Catch::Contains("\"materials\""));

  const Outcome quick = tamp_with("check --no-trial " + ball);
  CHECK(quick.exit_code == 0);
  CHECK_THAT(quick.out, Catch::Contains("  forecast: 11620 particles, ") && Catch::Contains("  advice  cells: ball"));
  CHECK_THAT(quick.out, !Catch::Contains("steps, ") && !Catch::Contains("core-seconds"));
}

TEST_CASE("the check prints a scene as JSON alone, which runs and is resolved to itself, and warns on stderr", "[slow]")
{
  const TemporaryFolder folder;

  const Outcome checked = tamp_with("check " + ball + " --json");
  const std::string plain = folder.write("plain.json", checked.out).string();
  const Outcome again = tamp_with("check " + plain + " --json");
  const Outcome ran = tamp_with("run " + plain + " --steps 1 --quiet --out " + (folder.path() / "run").string());

  INFO(checked.err << again.err << ran.err);
  REQUIRE(checked.exit_code == 0);
  REQUIRE(again.exit_code == 0);
  REQUIRE(ran.exit_code == 0);
  CHECK(scene_of(checked.out)["time"]["minimum_step"] == 1e-12);
  CHECK(scene_of(again.out) == scene_of(checked.out));
  CHECK(scene_of(read_text(folder.path() / "run/scene.json")) == scene_of(checked.out));
  CHECK_THAT(checked.err, Catch::Contains("tamp: warning: /bodies/ball/geometry: ") &&
                              Catch::Contains("  advice  cells: ball has 4.0 to its half width"));
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
