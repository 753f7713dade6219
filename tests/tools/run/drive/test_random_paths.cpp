#include <fmt/core.h>

#include <catch2/catch.hpp>

#include "tests/components/materials/random_paths.hpp"
#include "tools/scene/materials/read_material.hpp"

namespace test_random_paths
{

using namespace tamp;

// Long, so it runs only when asked for, and prints what it counts:
//
//     build/release/tests/tamp_tools_tests '[random-paths]'

namespace
{

void follow_shipped_sand(const std::string& model)
{
  const std::filesystem::path folder = TAMP_SOURCE_DIR "/inputs/materials/concrete-sand";
  fmt::print(
      "| model | form | steps | failed | not finite | split | substeps | limited | out of range | outside |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const char* form : {"state", "rate"}) {
    const auto material =
        tools::read_checked_material(folder / (model + ".json"), {std::string("/elastic_update=") + form}).material;

    const auto outcome = random_paths::follow(std::get<components::TabularCap>(material.model), 100'000);

    const components::UpdateCounts& n = outcome.counts;
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.2g} |\n", model, form, outcome.n_steps, n.failures,
               outcome.n_not_finite, n.split_updates, n.substeps, n.limited_substeps, n.extrapolated, outcome.outside);
    CHECK(n.failures == 0);
    CHECK(outcome.n_not_finite == 0);
    CHECK(outcome.outside < 1e-6);
  }
}

}  // namespace

TEST_CASE("on 100,000 random paths the table sand neither fails nor leaves the yield surface", "[.long][random-paths]")
{
  follow_shipped_sand("table");
}

TEST_CASE("on 100,000 random paths the SVR sand neither fails nor leaves the yield surface", "[.long][random-paths]")
{
  follow_shipped_sand("svr");
}

TEST_CASE("on 100,000 random paths the MLP sand neither fails nor leaves the yield surface", "[.long][random-paths]")
{
  follow_shipped_sand("mlp");
}

}  // namespace test_random_paths
