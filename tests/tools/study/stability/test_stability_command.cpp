#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_stability_command
{

using namespace tamp::test;
using Catch::Contains;
using Json = nlohmann::json;

namespace
{

/// A folder with entries of a block that falls, with and without local damping.
class Entries
{
 public:
  Entries()
  {
    draw_no_pages();
    folder_.write("inputs/stability/scenes/fall.json", R"({
      "dimension": 2, "grid": { "upper": [0.4, 1.2], "cell_size": 0.1 }, "gravity": [0, -10], "time": { "end": 0.2 },
      "materials": { "soft": { "type": "hypoelastic", "density": 1000, "bulk_modulus": 1e5, "shear_modulus": 5e4 } },
      "bodies": { "block": { "material": "soft", "velocity": [0, -1e-9],
                             "geometry": { "type": "box", "lower": [0.1, 0.6], "upper": [0.3, 0.8] } } },
      "output": { "history_interval": 0.1, "fields_interval": 1 }
    })");
    write("damped", "{}");
    write("unlike_told", R"({"stability": {"fails": "free", "survives": "damped"}})");
    write("shaken", R"({"methods": [{"name": "shaken", "set": {"/limits/energy_error": 1e-12,
                                                              "/bodies/block/angular_velocity": [50]}},
                                    {"name": "free"}], "stability": {"fails": "shaken"}})");
  }

  /// An entry that is as told, with a patch laid over it.
  void write(const std::string& name, const std::string& patch) const
  {
    Json entry = Json::parse(R"({
      "title": "A block that falls", "measure": { "run": "scenes/fall.json" },
      "methods": [{ "name": "damped", "set": { "/local_damping": 0.5 } }, { "name": "free" }],
      "quantities": [{ "name": "depth", "column": "block.depth[m]", "take": "last", "exact": 0.2 }],
      "stability": { "quantity": "depth", "threshold": 0.1, "fails": "damped", "survives": "free",
                     "symptom": "a slow fall", "monitor": "depth" },
      "repeat": 1
    })");
    entry.merge_patch(Json::parse(patch));
    folder_.write("inputs/stability/" + name + ".json", entry.dump());
  }

  Outcome run(const std::string& arguments) const
  {
    return outcome_of("cd " + folder_.path().string() + " && " + TAMP_PROGRAM + " stability --out out " + arguments);
  }

  std::string text(const std::string& file) const { return read_text(folder_.path() / file); }
  Json json(const std::string& file) const { return Json::parse(text(file)); }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("an entry that fails and survives as told ends with 0, and prints the table that is written", "[slow]")
{
  const Entries entries;

  const Outcome outcome = entries.run("damped --json list.json");

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == entries.text("out/stability.md"));
  CHECK_THAT(outcome.out, Contains("| damped | damped | 0.5 ") && Contains("| a slow fall | yes "));
  const Json results = entries.json("out/stability.json");
  CHECK(results["failures"].empty());
  REQUIRE(results["entries"].size() == 1);
  CHECK(results["entries"][0]["fails"]["error"].get<double>() == Approx(0.5).epsilon(1e-3));
  CHECK_THAT(results["entries"][0]["fails"]["command"].get<std::string>(),
             Contains("tamp run inputs/stability/scenes/fall.json") && Contains("--set /local_damping=0.5"));
  const Json point = entries.json("out/damped/study.json")["points"][0];
  // It comes to its end, and says that local damping takes half of what gravity gives.
  const Json summary = entries.json("out/damped/" + point["folder"].get<std::string>() + "/summary.json");
  CHECK(summary["status"] == "completed with warnings");
  const Json list = entries.json("list.json");
  REQUIRE(list.size() == 1);
  CHECK(list[0]["failed"] == true);
  CHECK(list[0]["survived"] == true);
}

TEST_CASE("a run that becomes unstable has failed as told", "[slow]")
{
  const Entries entries;

  const Outcome outcome = entries.run("shaken");

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("| shaken | shaken | unstable |"));
}

TEST_CASE("an entry that does not fail and survive as told ends with 3, after all are written", "[slow]")
{
  const Entries entries;

  const Outcome outcome = entries.run("unlike_told damped --quiet --jobs 2");

  CHECK(outcome.exit_code == 3);
  CHECK(outcome.out.empty());
  CHECK_THAT(outcome.err, Contains("1 of 2 entries do not fail and survive as told") &&
                              Contains("unlike_told: free: an error of ") &&
                              Contains("; damped: an error of 0.5, expected less than 0.0333"));
  CHECK_THAT(entries.text("out/stability.md"), Contains("**NO**") && Contains("| yes "));
}

TEST_CASE("an entry that says not what fails or what survives is refused before anything runs")
{
  const Entries entries;
  entries.write("damped", R"({"stability": {"fails": null}})");
  entries.write("shaken", R"({"stability": null})");

  const Outcome outcome = entries.run("");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("inputs/stability/damped.json#/stability/fails: missing") &&
                              Contains("inputs/stability/shaken.json#/stability: missing"));
  CHECK_THROWS(entries.json("out/stability.json"));
}

TEST_CASE("a name that is no entry's is refused, with what was meant")
{
  const Entries entries;

  const Outcome outcome = entries.run("damepd");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("damepd: no study of inputs/stability; did you mean damped?"));
}

TEST_CASE("FLIP's noise in the null space is among the shipped failures, and fails and survives as told", "[slow]")
{
  const TemporaryFolder folder;

  const Outcome outcome = tamp_with("stability null_space --out " + (folder.path() / "out").string());

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("| null_space | flip ") && Contains("| yes "));
}

}  // namespace test_stability_command
