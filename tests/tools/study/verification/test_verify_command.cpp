#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/background_program.hpp"
#include "tests/tools/program.hpp"

namespace test_verify_command
{

using namespace tamp::test;
using Catch::Contains;
using Json = nlohmann::json;

namespace
{

/// A folder with studies of a block that flies 0.1 m through an empty box: one expects what comes out, one does not.
class Studies
{
 public:
  explicit Studies(const std::string& time = R"({ "end": 1e-3 })")
  {
    draw_no_pages();
    folder_.write("inputs/verification/scenes/flight.json", R"({
      "dimension": 2, "grid": { "upper": [1, 1], "cell_size": 0.1 },
      "materials": { "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e9, "shear_modulus": 7e8 } },
      "bodies": { "block": { "material": "steel", "velocity": [0, -100],
                             "geometry": { "type": "box", "lower": [0.4, 0.6], "upper": [0.6, 0.8] } } },
      "output": { "history_interval": 1e-4, "fields_interval": 1e-3 },
      "time": )" + time + "}");
    write_study("sound", 0.1);
    write_study("unsound", 0.2);
    write_study("unsound_as_known", 0.2, "nobody's block");
    write_study("sound_unlike_known", 0.1, "nobody's block");
  }

  Outcome verify(const std::string& arguments) const { return outcome_of(in_folder("verify --out out " + arguments)); }

  /// A command line that runs the program there.
  std::string in_folder(const std::string& arguments) const
  {
    return "cd " + folder_.path().string() + " && " + TAMP_PROGRAM + " " + arguments;
  }

  /// Where env(1) can start the verification.
  std::string in_background(const std::string& arguments) const
  {
    return "-C " + folder_.path().string() + " " + TAMP_PROGRAM + " verify " + arguments;
  }

  std::string table() const { return read_text(folder_.path() / "out/verification.md"); }
  Json list() const { return Json::parse(read_text(folder_.path() / "list.json")); }
  Json results() const { return Json::parse(read_text(folder_.path() / "out/verification.json")); }

 private:
  void write_study(const std::string& name, double exact, const std::string& why_missed = "")
  {
    Json study = Json::parse(R"({
      "title": "A block that flies", "measure": { "run": "scenes/flight.json" }, "methods": [{ "name": "flight" }],
      "sweep": { "/grid/cell_size": [0.2, 0.1, 0.05] }, "refine": "/grid/cell_size",
      "quantities": [{ "name": "depth", "column": "block.depth[m]", "take": "greatest" }],
      "expect": [{ "quantity": "depth", "error_at_most": 1e-6, "why": "nothing acts on it" }],
      "repeat": 1, "short": { "sweep": { "/grid/cell_size": [0.2] } }
    })");
    study["quantities"][0]["exact"] = exact;
    if (!why_missed.empty()) study["expect"][0]["missed"] = {{"flight", why_missed}};
    folder_.write("inputs/verification/" + name + ".json", study.dump());
  }

  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("a verification whose expectations hold ends with 0, and prints the table that it writes", "[slow]")
{
  const Studies studies;

  const Outcome outcome = studies.verify("sound");

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == studies.table());
  CHECK_THAT(outcome.out, Contains("| method | 0.2 m") && Contains("| flight | ") && Contains("| yes "));
  CHECK(outcome.out.find("unsound") == std::string::npos);
  const Json results = studies.results();
  CHECK(results["failures"].empty());
  CHECK(results["studies"][0]["points"].size() == 3);
}

TEST_CASE("a verification writes a list of problems and methods where it is asked to", "[slow]")
{
  const Studies studies;

  CHECK(studies.verify("sound unsound --quiet --json list.json").exit_code == 3);

  const Json list = studies.list();
  REQUIRE(list.size() == 2);
  CHECK(list[0]["problem"] == "sound");
  CHECK(list[0]["method"] == "flight");
  CHECK(list[0]["errors"].size() == 3);
  CHECK(list[0]["errors"][0] < 1e-6);
  CHECK(list[0]["expected_order"].is_null());
  CHECK(list[0]["passed"] == true);
  CHECK(list[1]["passed"] == false);
  CHECK(studies.verify("sound --json inputs/verification/sound.json").exit_code == 2);
}

TEST_CASE("tamp bench verify is tamp verify, and says so", "[slow]")
{
  const Studies studies;

  const Outcome outcome = outcome_of(studies.in_folder("bench verify sound --short --quiet"));

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "tamp bench verify is now tamp verify\n");
}

TEST_CASE("a verification with an expectation that does not hold runs all studies, and ends with 3", "[slow]")
{
  const Studies studies;

  const Outcome outcome = studies.verify("sound unsound --short --quiet --jobs 2");

  CHECK(outcome.exit_code == 3);
  CHECK(outcome.out.empty());
  CHECK_THAT(outcome.err, Contains("1 of 2 expectations that are to hold do not") &&
                              Contains("unsound: flight, depth: error 50 %, expected error at most 0.0001 %"));
  CHECK_THAT(studies.table(), Contains("### sound") && Contains("### unsound") && Contains("**NO**") &&
                                  Contains("- does not hold: flight, depth: error 50 %"));
  CHECK(studies.results()["studies"][0]["points"].size() == 1);
}

TEST_CASE("a verification that misses what is known to be missed ends with 0, and says why it is", "[slow]")
{
  const Studies studies;

  const Outcome outcome = studies.verify("sound unsound_as_known --short");

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(
      studies.table(),
      Contains("no, as known") &&
          Contains("- missed, as known: flight, depth: error 50 %, expected error at most 0.0001 % (nobody's block)"));
  CHECK(studies.results()["failures"].empty());
  CHECK(studies.results()["known_misses"].size() == 1);
  CHECK_THAT(outcome.err,
             Contains("of 2 expectations 1 are known to be missed, 0 of them hold; 0 of the others do not"));
}

TEST_CASE("a verification in which something holds that is known to be missed ends with 0, and says so", "[slow]")
{
  const Studies studies;

  const Outcome outcome = studies.verify("sound_unlike_known --short --quiet");

  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("holds, though its study lists it under \"missed\": sound_unlike_known: flight, depth"));
  CHECK_THAT(studies.table(), Contains("- holds, though known to be missed: flight, depth: error"));
  CHECK(studies.results()["held_misses"].size() == 1);
}

TEST_CASE("a verification that is asked to stop ends the studies under way, and says so")
{
  const Studies studies(R"({ "end": 1e3 })");
  BackgroundProgram program("/usr/bin/env", studies.in_background("sound unsound --jobs 2"));
  wait_until([&] { return program.children().size() == 2; });
  const std::vector<pid_t> children = program.children();

  program.send(SIGTERM);

  CHECK(program.exit_code() == 128 + SIGTERM);
  for (const pid_t child : children) CHECK_FALSE(is_running(child));
}

TEST_CASE("a study that is named twice runs once", "[slow]")
{
  const Studies studies;

  const Outcome outcome = studies.verify("sound sound --short --quiet --jobs 2");

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(studies.results()["studies"].size() == 1);
}

TEST_CASE("a verification into a folder that cannot be made is refused before anything runs")
{
  const Studies studies;
  for (const std::string out : {"inputs/verification/sound.json/out", "inputs/verification/sound.json", "/proc/none"}) {
    const Outcome outcome = outcome_of("env " + studies.in_background("sound --out " + out));
    CHECK(outcome.exit_code == 4);
    CHECK_THAT(outcome.err, Catch::StartsWith("tamp: " + out + ": "));
  }
}

TEST_CASE("a verification of a study that there is not is refused before anything runs")
{
  const Studies studies;

  const Outcome outcome = studies.verify("sound soft");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("soft: no study of inputs/verification; expected one of sound, sound_unlike_known, "
                                   "unsound, unsound_as_known"));
  CHECK_THROWS(studies.results());
}

}  // namespace test_verify_command
