#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_limit_command
{

using namespace tamp::test;
using Catch::Contains;
using Json = nlohmann::json;

namespace
{

/// A swinging bar whose viscosity the published bound on the step leaves out: in steps of 0.4 of it the energy grows
/// without end, in steps of 0.2 it does not.
constexpr const char* viscous_bar = R"({
  "dimension": 2,
  "grid": { "upper": [25, 3.125], "cell_size": 1.5625 },
  "boundaries": { "x-": "periodic", "x+": "periodic" },
  "time": { "end": 4, "multiplier": 0.2, "rule": "published" },
  "artificial_viscosity": { "linear": 2 },
  "materials": {
    "soft": { "type": "hypoelastic", "density": 1, "bulk_modulus": 55.5555556, "shear_modulus": 33.3333333 }
  },
  "bodies": {
    "bar": {
      "material": "soft",
      "geometry": { "type": "box", "lower": [0, 0], "upper": [25, 3.125] },
      "problem": { "type": "vibrating_bar", "speed": 0.5, "wave_number": 0.25132741228718347, "drift": 0 }
    }
  },
  "output": { "fields_interval": 4, "history_interval": 0.05 }
})";

class LimitFolder
{
 public:
  LimitFolder()
  {
    draw_no_pages();
    folder_.write("bar.json", viscous_bar);
  }

  /// `tamp study FILE` with these options.
  Outcome run(const std::string& file, const std::string& options) const
  {
    return tamp_with("study " + (folder_.path() / file).string() + " --out " + out().string() + " " + options);
  }

  void write_study(const std::string& patch) const
  {
    Json study = Json::parse(R"({
      "measure": { "run": "bar.json" },
      "methods": [{ "name": "gimp" }, { "name": "little viscosity", "set": { "/artificial_viscosity/linear": 1 } }],
      "sweep": { "/grid/cell_size": [1.5625, 0.78125], "/time/multiplier": [0.2, 0.3] },
      "quantities": [
        { "name": "displacement", "column": "bar.displacement_error[m]", "take": "greatest", "exact": 0, "scale": 0.2 }]
    })");
    study.merge_patch(Json::parse(patch));
    folder_.write("study.json", study.dump());
  }

  std::filesystem::path out() const { return folder_.path() / "out"; }
  Json limits() const { return Json::parse(read_text(out() / "limit.json")); }
  bool has_run() const { return std::filesystem::exists(out()); }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("a scene has the step at which it stops being stable, and how far it is from that as written", "[slow]")
{
  const LimitFolder folder;

  const Outcome outcome = folder.run("bar.json", "--limit /time/multiplier");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json bar = folder.limits()["methods"].at(0);
  const double stable = bar["last_stable"], unstable = bar["first_unstable"];
  CHECK(bar["written"] == 0.2);
  CHECK(bar["written_is"] == "stable");
  CHECK(stable > 0.2);
  CHECK(unstable < 0.4);
  CHECK(unstable <= 1.02 * stable);
  CHECK(bar["written_over_last_stable"].get<double>() == Approx(0.2 / stable));
  CHECK_THAT(bar["why"].get<std::string>(), Contains("the energy is wrong by"));
  CHECK_THAT(bar["probes"][1]["command"].get<std::string>(), Contains("--set /time/multiplier=0.4"));
  CHECK(bar["probes"][1]["verdict"] == "unstable");
  CHECK_THAT(outcome.out, Contains("last stable") && Contains("bar") && Contains("limit of /time/multiplier"));
  CHECK_THAT(read_text(folder.out() / "limit.csv"), Contains("method,written,written_is,last_stable,first_unstable"));
}

TEST_CASE("a closer bound on the energy is a lower limit", "[slow]")
{
  const LimitFolder folder;
  REQUIRE(folder.run("bar.json", "--limit /time/multiplier --quiet").exit_code == 0);
  const double loose = folder.limits()["methods"][0]["last_stable"];

  const Outcome outcome =
      folder.run("bar.json", "--limit /time/multiplier --between 0.1,1 --energy-error 1e-4 --quiet");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json bar = folder.limits()["methods"][0];
  CHECK(bar["last_stable"].get<double>() < loose);
  CHECK_THAT(bar["why"].get<std::string>(), Contains("the energy is wrong by") && Contains("%"));
  for (const Json& probe : bar["probes"]) {
    if (probe["verdict"] == "stable") CHECK(probe["energy_error"].get<double>() <= 1e-4);
  }
}

TEST_CASE("each method of a study has a limit, with the first values of its sweep and by its own quantity", "[slow]")
{
  const LimitFolder folder;
  folder.write_study(R"({"sweep": {"/time/multiplier": null},
                         "stable_if": {"quantity": "displacement", "error_at_most": 0.5}})");

  const Outcome outcome = folder.run("study.json", "--limit /time/multiplier --within 0.1 --quiet");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json methods = folder.limits()["methods"];
  REQUIRE(methods.size() == 2);
  CHECK(methods[0]["method"] == "gimp, cell size 1.5625");
  CHECK(methods[1]["last_stable"].get<double>() > 1.2 * methods[0]["last_stable"].get<double>());
  for (const Json& method : methods) {
    for (const Json& probe : method["probes"]) {
      const bool is_near = probe["error"].is_number() && probe["error"].get<double>() <= 0.5;
      CHECK((probe["verdict"] == "stable") == is_near);
    }
  }
}

TEST_CASE("methods that sweep the setting have a limit for each of their other combinations, and others have none",
          "[slow]")
{
  const LimitFolder folder;
  folder.write_study(R"({"methods": [{"name": "gimp"}, {"name": "other", "sweep": {"/transfer": ["flip", "pic"]}}]})");

  const Outcome outcome = folder.run("study.json", "--limit /time/multiplier --within 0.5 --quiet");

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json methods = folder.limits()["methods"];
  REQUIRE(methods.size() == 2);
  CHECK(methods[0]["method"] == "gimp, cell size 1.5625");
  CHECK(methods[1]["method"] == "gimp, cell size 0.78125");
  CHECK(methods[0]["written"] == 0.2);
}

TEST_CASE("the runs of a limit are kept, and it is found again without them", "[slow]")
{
  const LimitFolder folder;
  REQUIRE(folder.run("bar.json", "--limit /time/multiplier --quiet").exit_code == 0);
  const Json first = folder.limits();
  const auto written = [&] {
    std::vector<std::filesystem::file_time_type> times;
    for (const auto& entry : std::filesystem::directory_iterator(folder.out() / "points")) {
      if (entry.is_directory()) times.push_back(std::filesystem::last_write_time(entry.path() / "result.json"));
    }
    return times;
  };
  const auto before = written();

  REQUIRE(folder.run("bar.json", "--limit /time/multiplier --quiet").exit_code == 0);

  CHECK(folder.limits() == first);
  CHECK(written() == before);
}

TEST_CASE("what is stable at both ends, or at neither, ends with 2 after what was found is written")
{
  const LimitFolder folder;

  const Outcome stable = folder.run("bar.json", "--limit /time/multiplier --between 0.1,0.2 --quiet");
  const Json of_stable = folder.limits();
  const Outcome unstable = folder.run("bar.json",
                                      "--limit /time/multiplier --between 0.5,1 "
                                      "--energy-error 1e-9 --quiet");

  CHECK(stable.exit_code == 2);
  CHECK_THAT(stable.err, Contains("--between: bar: stable at all 2 values from 0.1 to 0.2; expected values of which"));
  CHECK(of_stable["methods"][0]["last_stable"].is_null());
  CHECK(unstable.exit_code == 2);
  CHECK_THAT(unstable.err, Contains("--between: bar: unstable at all 3 values from 0.2 to 1"));
}

TEST_CASE("a limit of what is no number of the scene, and ends in the wrong order, are refused before anything runs")
{
  const LimitFolder folder;
  folder.write_study(R"({"stable_if": {"quantity": "depth"}})");
  const auto refused = [&](const std::string& file, const std::string& options, const std::string& says) {
    const Outcome outcome = folder.run(file, options);
    INFO(options);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains(says));
    CHECK_FALSE(folder.has_run());
  };

  refused("bar.json", "--limit /time/multiplyer", "--limit: /time/multiplyer: there is no such place");
  refused("bar.json", "--limit /grid/upper/99999999999999999999",
          "--limit: /grid/upper/99999999999999999999: there is no such place");
  refused("bar.json", "--limit multiplier", "--limit: multiplier: there is no such place");
  refused("bar.json", "--limit /interpolator",
          "--limit: /interpolator is \"gimp\"; expected a JSON pointer to a number");
  refused("bar.json", "--limit /time/multiplier --between 1,0.1",
          "--between: 1 and 0.1; expected the lower value first");
  refused("bar.json", "--limit /time/multiplier --between 0.1,0.1", "--between: 0.1 and 0.1");
  refused("bar.json", "--limit /time/multiplier --between 0.1,1e9", "--between: ");
  refused("bar.json", "--limit /time/multiplier --between 0,1", "--between: 0; expected above 0");
  refused("bar.json", "--between 0.1,1", "--limit");
  refused("bar.json", "--limit /time/multiplier --short", "--short: given with a scene");
  refused("study.json", "--limit /time/multiplier", "#/stable_if/quantity: \"depth\"; expected the name of a quantity");
}

}  // namespace test_limit_command
