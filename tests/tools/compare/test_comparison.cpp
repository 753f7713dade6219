#include <catch2/catch.hpp>

#include "tools/compare/comparison.hpp"
#include "tools/compare/comparison_report.hpp"

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

TEST_CASE("a reason with commas and quotes is one cell of the table")
{
  ModelResult model = model_of("table", {1});
  model.instability = "step 3, particle \"7\"";

  CHECK_THAT(to_csv(comparison_of({model})), Contains("unstable,\"step 3, particle \"\"7\"\"\","));
}

}  // namespace test_comparison
