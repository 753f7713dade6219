#include <catch2/catch.hpp>

#include "tests/components/materials/concrete_sand.hpp"
#include "tests/components/materials/random_paths.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_random_paths
{

using namespace tamp::components;

TEST_CASE("on random paths of steps up to 5 % the sand never fails and never leaves the yield surface")
{
  for (const ElasticUpdate form : {ElasticUpdate::state, ElasticUpdate::rate}) {
    const TabularCap sand = concrete_sand::sand(form);

    const random_paths::Outcome outcome = random_paths::follow(sand, tamp::test::n_steps_of(2000));

    CAPTURE(form == ElasticUpdate::state, outcome.n_steps, outcome.counts.split_updates);
    CHECK(outcome.counts.failures == 0);
    CHECK(outcome.n_not_finite == 0);
    CHECK(outcome.outside < 1e-6);
    // Without substeps the test would try less than it says.
    CHECK(outcome.counts.split_updates > outcome.n_steps / 10);
  }
}

}  // namespace test_random_paths
