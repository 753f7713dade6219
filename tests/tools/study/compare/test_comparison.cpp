#include <catch2/catch.hpp>

#include "tools/study/compare/comparison.hpp"
#include "tools/study/compare/comparison_report.hpp"

namespace test_comparison
{

using namespace tamp::tools::compare;
using Catch::Contains;

namespace
{

/// A model whose steps took these times, one round each of two steps.
ModelResult model_of(const std::string& name, const std::vector<double>& step_seconds)
{
  ModelResult model;
  model.name = name;
  for (std::size_t r = 0; r < step_seconds.size(); ++r) {
    model.rounds.push_back({1e-3 * static_cast<double>(r + 1), 2, step_seconds[r]});
    model.samples.push_back({1e-3 * static_cast<double>(r), 5e-4, 0, {0.1}, {2e6}, {1e6}});
    model.steps += 2;
  }
  return model;
}

Comparison comparison_of(std::vector<ModelResult> models)
{
  return {"punch", "A <punch> & sand", 4, 1, {"punch"}, {"sand"}, std::move(models)};
}

}  // namespace

TEST_CASE("noise that slows a whole round does not change the ratio")
{
  const Comparison both = comparison_of({model_of("table", {1, 1, 10, 1, 30}), model_of("svr", {4, 4, 40, 4, 120})});

  const auto ratio = ratio_to_table(both, both.models[1]);

  REQUIRE(ratio);
  CHECK(ratio->lower == 4);
  CHECK(ratio->median == 4);
  CHECK(ratio->upper == 4);
}

TEST_CASE("rounds in which either model made no step do not count")
{
  ModelResult svr = model_of("svr", {3, 9, 9});
  svr.rounds[1].steps = 0;
  svr.rounds.pop_back();
  const Comparison all = comparison_of({model_of("table", {1, 1, 1}), svr, model_of("mlp", {})});

  CHECK(ratio_to_table(all, all.models[1])->median == 3);
  CHECK_FALSE(ratio_to_table(all, all.models[2]));
}

TEST_CASE("without a table there is no ratio to it")
{
  const auto json = to_json(comparison_of({model_of("svr", {1, 2})}));

  CHECK(json["models"][0]["ratio_to_table"].is_null());
}

TEST_CASE("models are compared at the last time that all have reached, straight between samples")
{
  ModelResult fast = model_of("table", {1, 1, 1}), slow = model_of("svr", {1, 1});
  fast.samples = {{0, 1e-3, 0, {0}, {0}, {0}}, {2e-3, 1e-3, 0, {0.2}, {4e6}, {2e6}}};
  slow.samples = {{0, 1e-3, 0, {0}, {0}, {0}}, {1e-3, 1e-3, 0, {0.101}, {2e6}, {1.1e6}}};
  const Comparison both = comparison_of({fast, slow});

  CHECK(common_time(both) == 1e-3);
  CHECK(depth_at(both.models[0], 1e-3) == Approx(0.1));
  CHECK(q_at(both.models[0], 1e-3) == Approx(1e6));
  CHECK(std::isnan(depth_at(both.models[1], 2e-3)));
  CHECK_THAT(to_text(both), Contains("0.1000") && Contains("0.1010") && !Contains("0.2000") &&
                                Contains("what the grid changes is not known"));
}

TEST_CASE("a difference is held against what cells twice as large change")
{
  ModelResult table = model_of("table", {1}), svr = model_of("svr", {1}), coarser = model_of("coarser", {1});
  table.samples = {{1e-3, 1e-3, 0, {0.1}, {2e6}, {1e6}}};
  svr.samples = {{1e-3, 1e-3, 0, {0.101}, {2e6}, {1.1e6}}};
  coarser.samples = {{1e-3, 1e-3, 0, {0.097}, {2e6}, {0.95e6}}};
  Comparison all = comparison_of({table, svr});
  all.coarser = coarser;

  CHECK_THAT(to_text(all), Contains("+1 % (less than by the grid)") && Contains("+10 % (more than by the grid)") &&
                               Contains("difference from table:") && !Contains("error"));
  CHECK(to_json(all)["coarser"]["depth_at_common_time_m"] == 0.097);
  CHECK(to_json(all)["models"][1]["depth_at_common_time_m"] == 0.101);
}

TEST_CASE("a reason with commas and quotes is one cell of the table")
{
  ModelResult model = model_of("table", {1});
  model.instability = "step 3, particle \"7\"";

  CHECK_THAT(to_csv(comparison_of({model})), Contains("unstable,\"step 3, particle \"\"7\"\"\","));
}

}  // namespace test_comparison
