#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_profile_command
{

using namespace tamp::test;
namespace fs = std::filesystem;

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

TEST_CASE("a profile is shown by rank, by phase and by patch, and beside that of another run", "[slow]")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 60 --quiet --out " + out).exit_code == 0);
  const auto shown = [&](const std::string& options) { return tamp_with("profile " + out + " " + options).out; };

  CHECK_THAT(shown("--phase 'update stress'"), Catch::Contains("update stress: sand") &&
                                                   Catch::Contains("update stress: steel") &&
                                                   !Catch::Contains("grid to particles"));
  CHECK_THAT(shown("--rank 0,0"), Catch::StartsWith("rank 0: a step takes") && Catch::Contains("\n\nrank 0: "));
  CHECK_THAT(shown("--patches"), Catch::Contains("4 patches: ") && Catch::Contains("update stress: sand"));
  CHECK_THAT(shown("--chain"), Catch::Contains("the longest chain takes") && Catch::Contains("update stress: sand"));
  const std::string beside_itself = shown("--compare " + out);
  CHECK_THAT(beside_itself,
             Catch::Contains("a step ") && Catch::Contains("1.000 +- 0.000") && !Catch::Contains("slower there"));
  CHECK(nlohmann::json::parse(shown("--compare " + out + " --format json"))[0]["ratio"] == 1);
}

TEST_CASE("a profile says what the run ran on, and compares tasks with the memory of no other machine")
{
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "run";
  REQUIRE(
      tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 20 --threads 1 --quiet --out " + out.string())
          .exit_code == 0);

  const Outcome here = tamp_with("profile " + out.string());
  // Sanitizers take more by themselves.
  const std::string limit = TAMP_SANITIZED ? "" : "ulimit -v 300000; ";
  const Outcome in_little = outcome_of(limit + TAMP_PROGRAM " profile " + out.string());
  auto profile = nlohmann::json::parse(read_text(out / "profile.json"));
  const nlohmann::json machine = profile["machine"];
  profile["machine"]["processor"] = "another one";
  folder.write("run/profile.json", profile.dump());
  const Outcome elsewhere = tamp_with("profile " + out.string());

  CHECK(machine["ranks"] == 1);
  CHECK(machine["threads"] == 1);
  for (const char* key : {"host", "processor", "instruction_set", "version", "build", "compiler"}) {
    CHECK_FALSE(machine.at(key).get<std::string>().empty());
  }
  CHECK(machine.contains("commit"));
  CHECK_THAT(here.out, Catch::Contains("of mem") && Catch::Contains("GB/s to a worker"));
  CHECK(in_little.exit_code == 0);
  CHECK_THAT(in_little.out, Catch::Contains("update stress: sand"));
  CHECK(elsewhere.exit_code == 0);
  CHECK_THAT(elsewhere.out, Catch::Contains("update stress: sand") && !Catch::Contains("of mem"));
}

TEST_CASE("what is not in a profile, or no run, is refused with what there is")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 2 --quiet --out " + out).exit_code == 0);
  const auto refused = [&](const std::string& options, int code, const std::string& words) {
    const Outcome outcome = tamp_with("profile " + options);
    CHECK(outcome.exit_code == code);
    CHECK_THAT(outcome.err, Catch::Contains(words));
  };

  refused(out + " --rank 0,1", 2, "--rank: 1; expected 0 to 0");
  refused(out + " --rank ''", 2, "expected a whole number, at least 0");
  refused(out + " --rank 99999999999999999999", 2, "expected a whole number, at least 0");
  refused(out + " --phase 'update stres'", 2, "did you mean update stress?");
  refused(out + " --patches --rank 0", 2, "--patches");
  refused(out + " --patches --format json", 2, "--format: json of a part of the profile; expected it of all, or with");
  refused(out + " --compare " + out + " --format html", 2,
          "--format: html of a part of the profile; expected it of all");
  refused(folder.path().string(), 2, "no run; expected the folder of a run");
  fs::rename(out + "/profile.json", out + "/old.json");
  refused(out, 4, "profile.json: is missing");
  refused(out + " --format html", 4, "profile.json: is missing");
}

TEST_CASE("lists of a profile that are none, or empty where no run leaves them so, are damage")
{
  const TemporaryFolder folder;
  const std::string command = "profile " + folder.path().string();
  const std::string rest = R"(, "ranks": [], "patches": {}, "longest_chain": null, "steps": 1, "step_s": 1})";
  folder.write("profile.json", R"({"tasks": [])" + rest);
  const std::string view = GENERATE("", " --phase stress", " --rank 0", " --patches", " --chain");

  CHECK(tamp_with(command + view).exit_code == 4);
}

TEST_CASE("numbers of a profile that no run comes to are damage, whoever reads them", "[slow]")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 3 --quiet --out " + out).exit_code == 0);
  const auto sound = nlohmann::json::parse(read_text(out + "/profile.json"));
  const auto damaged_with = [&](const nlohmann::json::json_pointer& place, double number) {
    nlohmann::json damaged = sound;
    damaged[place] = number;
    folder.write("run/profile.json", damaged.dump());
    const std::string profile = "profile " + out;
    std::string compared = profile + " --compare ";
    compared += out;
    for (const std::string& command : {profile, profile + " --chain", compared, profile + " --format json",
                                       "graph " TAMP_SOURCE_DIR "/inputs/punch/quick.json --threads 2 --run " + out}) {
      CAPTURE(place, number, command);
      const Outcome outcome = tamp_with(command);
      CHECK(outcome.exit_code == 4);
      CHECK_THAT(outcome.err, Catch::Contains("profile.json: is damaged: a value is out of range"));
    }
  };
  const auto instance = "/mean_step"_json_pointer / sound["mean_step"].begin().key() / 0;

  for (const double number : {1e308, -1e300, -1e-6}) {
    damaged_with("/step_s"_json_pointer, number);
    damaged_with("/tasks/0/mean_s"_json_pointer, number);
    damaged_with("/tasks/0/over_time_s/0"_json_pointer, number);
    damaged_with("/longest_chain/0/s"_json_pointer, number);
  }
  damaged_with("/memory/total"_json_pointer, 1e308);
  damaged_with("/longest_chain/0/patch"_json_pointer, 99);
  damaged_with("/longest_chain/0/rank"_json_pointer, 1);
  damaged_with("/patches/0/rank"_json_pointer, 1);
  damaged_with(instance / 0, 99);
  damaged_with(instance / 3, 1e308);
}

TEST_CASE("a profile of a machine that was too busy, and runs that are unlike, are said to be so", "[slow]")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string(), other = (folder.path() / "other").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 20 --threads 1 --quiet --out " + out)
              .exit_code == 0);
  auto profile = nlohmann::json::parse(read_text(out + "/profile.json"));
  fs::create_directories(other);
  const auto write_other = [&] { folder.write("other/profile.json", profile.dump()); };
  const std::string beside = "profile " + out + " --compare " + other;

  write_other();
  CHECK_THAT(tamp_with(beside).out, !Catch::Contains("differ in more") && !Catch::Contains("too busy"));
  profile["machine"]["ranks"] = 3;
  profile["machine"]["threads"] = 4;
  profile["core_share"] = 0.6;
  profile["too_busy"] = true;
  write_other();
  const Outcome unlike = tamp_with(beside), as_json = tamp_with(beside + " --format json");

  CHECK(unlike.exit_code == 0);
  CHECK_THAT(unlike.out, Catch::Contains("ranks 1 here, 3 there; threads of each 1 here, 4 there") &&
                             Catch::Contains("there: too busy to trust: other programs had these cores for 40 %"));
  CHECK_THAT(as_json.err, Catch::Contains("ranks 1 here, 3 there") && Catch::Contains("too busy to trust"));
  CHECK(nlohmann::json::parse(as_json.out)[0]["name"] == "a step");
  CHECK_THAT(tamp_with("profile " + other).out, Catch::Contains("too busy to trust"));
  profile["machine"]["ranks"] = 1;
  write_other();
  const std::string graph = "graph " TAMP_SOURCE_DIR "/inputs/punch/quick.json --run " + other;
  CHECK_THAT(tamp_with(graph + " --threads 2").out, Catch::Contains("too busy to trust"));
  CHECK_THAT(tamp_with(graph + " --format html").out, Catch::Contains("too busy with other programs"));
}

TEST_CASE("the page of a run says how it ended, how far to trust it, and where its time went", "[slow]")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 60 --quiet --out " + out).exit_code == 0);

  const Outcome drawn = tamp_with("profile " + out + " --format html");

  CHECK(drawn.exit_code == 0);
  CHECK(drawn.out == "written to " + out + "/report.html\n");
  const std::string page = read_text(out + "/report.html");
  for (const char* words :
       {"after 60 steps", "energy drift", "The particles at 0 s", "Speed at", "cells across punch", "cubic B-splines",
        "Force on punch against its depth", "Step size", "The median of the 20 traced steps",
        "update stress: sand, patch 3", "forecast of all", "cap state"}) {
    CHECK_THAT(page, Catch::Contains(words));
  }
  // On a busy machine one worker may do all.
  const bool somebody_waited = !nlohmann::json::parse(read_text(out + "/profile.json"))["waits"].empty();
  CHECK((page.find("What workers waited for") != std::string::npos) == somebody_waited);
  CHECK_THAT(page, !Catch::Contains("http://") || Catch::Contains("http://www.w3.org"));
  CHECK_THAT(page, !Catch::Contains("https://"));
}

TEST_CASE("a page is not drawn of damaged files of a run, which are named", "[slow]")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 3 --quiet --out " + out).exit_code == 0);
  const auto drawn_with = [&](const std::string& file, const std::string& content) {
    const std::string sound = read_text(out + "/" + file);
    folder.write("run/" + file, content);
    const Outcome outcome = tamp_with("profile " + out + " --format html");
    folder.write("run/" + file, sound);
    CAPTURE(file, content);
    CHECK(outcome.exit_code == 4);
    CHECK_THAT(outcome.err, Catch::Contains(out + "/" + file));
  };

  for (const char* content : {"", "{", "[]", R"({"traceEvents": [{"ph": "X", "args": {"step": 1}}]})"}) {
    drawn_with("trace.json", content);
  }
  const auto json_of = [&](const char* file) { return nlohmann::json::parse(read_text(out + "/" + file)); };
  auto trace = json_of("trace.json"), scene = json_of("scene.json"), summary = json_of("summary.json");
  for (auto& event : trace["traceEvents"]) {
    if (event.contains("dur")) event["dur"] = 0;
  }
  scene.erase("contact");
  summary.erase("ledger_peak_bytes");
  drawn_with("trace.json", trace.dump());
  drawn_with("scene.json", scene.dump());
  drawn_with("summary.json", summary.dump());
  drawn_with("scene.json", "{}");
  drawn_with("summary.json", "{");
  drawn_with("history.csv", "step,time[s]\n0,x\n");
  CHECK(tamp_with("profile " + out + " --format html").exit_code == 0);
}

TEST_CASE("the page of a run with damaged fields has no pictures, but all else and the reason", "[slow]")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 3 --quiet --out " + out).exit_code == 0);
  folder.write("run/fields.h5", "no fields");

  const Outcome drawn = tamp_with("profile " + out + " --format html");

  CHECK(drawn.exit_code == 0);
  const std::string page = read_text(out + "/report.html");
  CHECK_THAT(page, Catch::Contains("There are no pictures of the run") && Catch::Contains("fields.h5: cannot"));
  CHECK_THAT(page, Catch::Contains("Step size"));
}

TEST_CASE("the page of a run says what it cannot draw: a step where none was traced, particles without fields",
          "[slow]")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "run").string();
  REQUIRE(tamp_with("run " TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 3 --trace-steps none --quiet --out " + out)
              .exit_code == 0);
  fs::remove(out + "/fields.h5");

  const Outcome drawn = tamp_with("profile " + out + " --format html");

  CHECK(drawn.exit_code == 0);
  const std::string page = read_text(out + "/report.html");
  CHECK_THAT(page, Catch::Contains("No step was traced") && Catch::Contains("wrote no fields"));
}

}  // namespace test_profile_command
