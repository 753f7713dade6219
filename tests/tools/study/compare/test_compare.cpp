#include <sys/wait.h>

#include <catch2/catch.hpp>

#include "tasks/simulation.hpp"
#include "tests/tools/impact.hpp"
#include "tools/study/compare/compare.hpp"

namespace test_compare
{

using namespace tamp;
using Catch::Contains;
using tools::Json;

namespace
{

struct Outcome {
  int exit_code;
  std::string err;
};

Outcome compare_with(const test::TemporaryFolder& folder, const std::string& arguments)
{
  const std::string err = (folder.path() / "err").string();
  const std::string line =
      std::string(TAMP_PROGRAM) + " compare " + arguments + " --threads 1 --quiet >/dev/null 2>" + err;
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::read_text(err)};
}

}  // namespace

TEST_CASE("a comparison writes its table, its figures and its page", "[slow]")
{
  const test::TemporaryFolder folder;
  const auto scene = test::write_impact(folder);
  const auto out = folder.path() / "out";

  const Outcome outcome = compare_with(folder, scene.string() + " --models table --steps 10 --out " + out.string());

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Json model = Json::parse(test::read_text(out / "compare.json"))["models"][0];
  for (const char* key :
       {"wall_per_step_s", "ratio_to_table", "dt_mean_s", "modulus_ns_per_eval", "modulus_evaluations",
        "peak_rss_bytes", "ledger_peak_bytes", "depth_m", "depth_max_m", "p_max_Pa", "q_max_Pa"}) {
    INFO(key);
    CHECK(model.at(key).is_number());
  }
  CHECK(model["steps"] == 10);
  CHECK(model["ratio_to_table"] == 1);
  CHECK_THAT(test::read_text(out / "compare.csv"),
             Catch::StartsWith("model,status,") && Contains("\ntable,completed,"));
  const std::string page = test::read_text(out / "report.html");
  CHECK_THAT(page, Contains("<svg") && Contains("Depth of block") && Contains("Largest mean stress in sand"));
  CHECK_THAT(page, Contains("Ratio to Table") && Contains("</html>"));
  CHECK(std::filesystem::exists(out / "table/history.csv"));
  CHECK_FALSE(std::filesystem::exists(out / "table/alone"));
}

TEST_CASE("a comparison of several models has the first of them on cells twice as large, unless that is not wanted",
          "[slow]")
{
  const test::TemporaryFolder folder;
  const auto scene = test::write_impact(folder);
  const auto with = folder.path() / "with", without = folder.path() / "without";
  const std::string call = scene.string() + " --models table,table --steps 10 --out ";

  REQUIRE(compare_with(folder, call + with.string()).exit_code == 0);
  REQUIRE(compare_with(folder, call + without.string() + " --no-grid-error").exit_code == 0);

  CHECK(std::filesystem::exists(with / "coarser/history.csv"));
  CHECK(Json::parse(test::read_text(with / "compare.json"))["coarser"]["depth_at_common_time_m"].is_number());
  CHECK_FALSE(std::filesystem::exists(without / "coarser"));
  CHECK(Json::parse(test::read_text(without / "compare.json"))["coarser"].is_null());
}

TEST_CASE("a comparison's page needs no other file and no network", "[slow]")
{
  const test::TemporaryFolder folder;
  const auto out = folder.path() / "out";

  const Outcome outcome =
      compare_with(folder, test::write_impact(folder).string() + " --models table --steps 10 --out " + out.string());

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const std::string page = test::read_text(out / "report.html");
  REQUIRE_THAT(page, Contains("<svg"));
  CHECK_THAT(page, !Contains("src=") && !Contains("href=\"http") && !Contains("url(http") && !Contains("@import"));
}

TEST_CASE("a model that is compared with itself ends in the same state, that of a run of its own")
{
  const test::TemporaryFolder folder;
  const auto scenes = tools::compare::read_model_scenes(test::write_impact(folder), {}, {"table", "table"});
  tools::compare::Options options;
  options.folder = folder.path() / "out";
  options.quiet = true;
  const auto folders = prepare_folders(options, scenes);

  const tools::compare::Comparison comparison = tools::compare::compare(scenes, options);

  const tasks::Scene& scene = scenes[0].scene.scene;
  const auto alone = tasks::Simulation::make(scene, 1);
  while (alone->time() < scene.time.end) alone->advance(scene.time.end);
  REQUIRE(comparison.models.size() == 2);
  CHECK(comparison.models[1].name == "table-2");
  for (const tools::compare::ModelResult& model : comparison.models) {
    CHECK(model.digest == alone->digest());
    CHECK(model.steps == alone->n_steps());
    CHECK(model.rounds.size() == comparison.models[0].rounds.size());
    CHECK(model.samples.back().time == scene.time.end);
  }
}

TEST_CASE("a model that goes wrong ends with 3, and the comparison is written all the same")
{
  const test::TemporaryFolder folder;
  const auto scene = test::write_impact(folder);
  const auto out = folder.path() / "out";

  const Outcome outcome =
      compare_with(folder, scene.string() + " --models table --set /time/minimum_step=1 --out " + out.string());

  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.err, Contains("tamp: table: step 0") && Contains("below the minimum"));
  CHECK(Json::parse(test::read_text(out / "compare.json"))["models"][0]["status"] == "unstable");
  CHECK_THAT(test::read_text(out / "report.html"), Contains("table became unstable"));
}

TEST_CASE("an unknown model ends with 2 and names the known ones")
{
  const test::TemporaryFolder folder;

  const Outcome outcome = compare_with(folder, test::write_impact(folder).string() + " --models table,oracle");

  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err ==
        "tamp: --models: \"oracle\"; expected some of table, svr, mlp, table-compiled, svr-compiled, "
        "mlp-compiled\n");
}

TEST_CASE("a scene without sand cannot be compared")
{
  const test::TemporaryFolder folder;
  const auto scene = folder.write("scene.json", test::small_scene);

  CHECK(compare_with(folder, scene.string() + " --models table").exit_code == 2);
}

TEST_CASE("a comparison's folder that is not empty is refused unless force is given", "[slow]")
{
  const test::TemporaryFolder folder;
  const auto scene = test::write_impact(folder);
  const std::string line = scene.string() + " --models table --steps 2 --out " + (folder.path() / "out").string();
  REQUIRE(compare_with(folder, line).exit_code == 0);

  CHECK(compare_with(folder, line).exit_code == 2);
  CHECK(compare_with(folder, line + " --force").exit_code == 0);
}

}  // namespace test_compare
