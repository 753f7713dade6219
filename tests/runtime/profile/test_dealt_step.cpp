#include "runtime/profile/dealt_step.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "runtime/profile/mean_step.hpp"
#include "runtime/profile/report.hpp"
#include "tests/runtime/heat.hpp"

namespace tamp::runtime::test_dealt_step
{

namespace
{

const CellLabel<double, "first"> first;
const CellLabel<double, "second"> second;

TaskList make_and_use()
{
  return {
      task("make").over_patches_and_groups().computes(first).body([](const TaskContext&, auto) {}),
      task("use").over_patches_and_groups().reads(first).computes(second).body([](const TaskContext&, auto) {}),
  };
}

/// Three patches in a row.
struct Row {
  PatchLayout layout{{2, {0, 0, 0}, 1, {9, 3, 1}}, {3, 1, 1}};
  TaskGraph graph{make_and_use(), layout, {"only"}, {{}, {&second}}};
};

}  // namespace

TEST_CASE("patches in a row are dealt to threads, and what does not wait is in one level", "[profile]")
{
  const Row row;

  const DealtStep dealt = deal_to_threads(row.graph, 2);

  REQUIRE(dealt.shares.size() == 2);
  CHECK(dealt.shares[0].n_patches == 2);
  CHECK(dealt.shares[0].n_instances == 4);
  CHECK(dealt.shares[1].n_patches == 1);
  CHECK(dealt.shares[1].n_instances == 2);
  CHECK(dealt.levels == std::vector<int>{3, 3});
  CHECK_THAT(to_text(dealt), Catch::Contains("6 instances in 2 levels, 3.0 on average and 3 at most; 0 levels are"));
}

TEST_CASE("a step of known times is as fast on more threads as its patches allow", "[profile]")
{
  const Row row;
  const TimedStep step{&row.graph, std::vector<double>(6, 1e-6), {}};

  const std::string text = replays_text(step, 3, 1, 7e-6);

  CHECK(deal_to_threads(step, 2).shares[0].work_s == Approx(4e-6));
  // Six microseconds of work, of which two patches take four and one takes two.
  CHECK_THAT(text, Catch::Contains("      1          6.0     1.00       1.00\n"));
  CHECK_THAT(text, Catch::Contains("      3          2.0     3.00       1.00\n"));
  CHECK_THAT(text, Catch::Contains("the longest chain takes 2.0 us") && Catch::Contains("7.0 us on 1, by replay 6.0"));
}

TEST_CASE("the mean step of a profile is that of its graph again", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();
  test::Heat heat(24, {4, 3, 1}, 1, ranks);
  std::vector<int> turned;
  for (const Patch& patch : heat.engine.layout()) turned.push_back(patch.id % ranks.size());
  heat.engine.deal(turned);
  heat.run(20, 1e-4);

  const Profile profile = heat.engine.profile();
  const nlohmann::json json = to_json(profile, heat.engine.warehouse().ledger(), ranks);
  if (!ranks.is_first()) return;
  const auto step = timed_step(heat.engine.graph(), json);

  CHECK(profile.mean_step.size() == heat.engine.graph().instances().size());
  REQUIRE(step);
  CHECK(replay(*step, 1) == Approx(profile.replayed_s));
  CHECK(longest_chain(*step).length_s == Approx(profile.longest_chain_s));
}

TEST_CASE("the mean step of a profile is that of no graph with other instances")
{
  test::Heat heat(24, {4, 3, 1}, 1);
  const test::Heat in_fewer_patches(24, {4, 2, 1}, 1), in_more_patches(24, {4, 4, 1}, 1);
  heat.run(20, 1e-4);

  const nlohmann::json json = to_json(heat.engine.profile(), heat.engine.warehouse().ledger());

  CHECK(timed_step(heat.engine.graph(), json));
  CHECK_FALSE(timed_step(in_fewer_patches.engine.graph(), json));
  CHECK_FALSE(timed_step(in_more_patches.engine.graph(), json));
}

}  // namespace tamp::runtime::test_dealt_step
