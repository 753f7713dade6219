#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_budgets
{

/// Inputs that would take for ever, or too much memory, are refused at once.
using namespace tamp::test;

namespace
{

/// Answer of the check to a scene with an assignment; it must not take long.
Outcome checked_with(const std::string& assignments)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("small.json", small_scene).string();
  return outcome_of("timeout 120 " TAMP_PROGRAM " check " + file + " " + assignments);
}

std::string repeated(const std::string& text, int n)
{
  std::string all;
  for (int i = 0; i < n; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("outputs without number are refused")
{
  const std::string key = GENERATE(as<std::string>(), "history_interval=1e-18", "fields_interval=1e-300");

  const Outcome outcome = checked_with("--set /output/" + key);

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Catch::Contains("outputs until the end"));
  CHECK(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --checkpoint-time 1e-20").exit_code == 2);
}

TEST_CASE("particles without number are refused, however their cells come about")
{
  CHECK(checked_with("--set /particles_per_cell=[20000,20000]").exit_code == 2);
  const Outcome small_cells = checked_with("--set /grid/cell_size=0.000004 --set /grid/patches=[1,1]");
  CHECK(small_cells.exit_code == 2);
  CHECK_THAT(small_cells.err, Catch::Contains("of memory; expected at most"));
  CHECK(checked_with("--set /grid/cell_size=0.001 --set /grid/patches=[1000,1000]").exit_code == 2);
}

TEST_CASE("JSON of many levels is refused, in a file and on the command line")
{
  const TemporaryFolder folder;
  const auto deep =
      folder.write("deep.json", "{\"materials\": " + repeated("[", 300'000) + repeated("]", 300'000) + "}");

  const Outcome file = tamp_with("check " + deep.string());

  CHECK(file.exit_code == 2);
  CHECK_THAT(file.err, Catch::Contains("more than 100 levels"));
  CHECK(checked_with("--set /gravity=" + repeated("[", 20'000) + repeated("]", 20'000)).exit_code == 2);
  CHECK(checked_with("--set " + repeated("/a", 20'000) + "=1").exit_code == 2);
}

TEST_CASE("what is no file is refused as an input")
{
  const TemporaryFolder folder;
  const std::string fifo = folder.path().string() + "/fifo";
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  for (const std::string& file : {fifo, std::string("/dev/zero")}) {
    for (std::string command : {std::string("check "), std::string("modulus --at 0.1,0.1 "), "drive " + file + " "}) {
      command += file;
      const Outcome outcome = outcome_of("timeout 120 " TAMP_PROGRAM " " + command);
      INFO(command << ": " << outcome.err);
      CHECK(outcome.exit_code == 2);
    }
  }
}

TEST_CASE("solids without number are refused")
{
  const TemporaryFolder folder;
  const auto twice =
      folder.write("twice.json", R"({"type": "union", "of": [{"file": "twice.json"}, {"file": "twice.json"}]})");
  const std::string ball = R"({"type": "ball", "centre": [1, 1], "radius": 0.1})";
  const std::string ring = R"({"type": "ring", "count": 1000, "of": )";
  const std::string transform = R"({"type": "transform", "of": )";
  const auto rings = folder.write("rings.json", ring + ring + ring + ball + "}}}");
  const auto transforms = folder.write("transforms.json", repeated(transform, 10'000) + ball + repeated("}", 10'000));

  for (const auto& file : {twice, rings, transforms}) {
    const Outcome outcome = checked_with("--set '/bodies/block/geometry={\"file\":\"" + file.string() + "\"}'");
    INFO(file << ": " << outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.size() < 20'000);
  }
}

TEST_CASE("support vectors without number are refused", "[slow]")
{
  const TemporaryFolder folder;
  const auto file = folder.write("svr.json", R"({"support_vectors": [)" + repeated("[0,0],", 1'000'000) + "[0,0]]}");

  const Outcome outcome = outcome_of("timeout 240 " TAMP_PROGRAM " modulus " + file.string() + " --at 0.1,0.1");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Catch::Contains("1000001 of them; expected at most"));
}

TEST_CASE("a message has an end")
{
  const Outcome place = checked_with("--set /contact/1000000=1");
  CHECK(place.exit_code == 2);
  CHECK_THAT(place.err, Catch::Contains("there is no such place in the scene"));

  const Outcome many = checked_with("--set '/contact=[" + repeated("1,", 1000) + "1]'");
  CHECK(many.exit_code == 2);
  CHECK_THAT(many.err, Catch::EndsWith("more problems\n"));
  CHECK(std::count(many.err.begin(), many.err.end(), '\n') == 51);
}

}  // namespace test_budgets
