#include "runtime/execute/rank_clocks.hpp"

#include <catch2/catch.hpp>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"
#include "tests/runtime/shared_cores.hpp"

namespace tamp::runtime::test_rank_clocks
{

namespace
{

const CellLabel<double, "old value"> value;

/// Each patch reads its neighbours, and each rank has one patch.
TaskDeclaration pass_on()
{
  return task("pass on")
      .over_patches_and_groups()
      .reads(value.previous().halo(1))
      .computes(value)
      .body([](const TaskContext&, auto) {});
}

PatchLayout patch_on_each(int n_ranks)
{
  PatchLayout layout({2, {0, 0, 0}, 1, {2 * n_ranks, 2, 1}}, {n_ranks, 1, 1});
  std::vector<int> ranks(static_cast<std::size_t>(n_ranks));
  for (int rank = 0; rank < n_ranks; ++rank) ranks[static_cast<std::size_t>(rank)] = rank;
  layout.give_to_ranks(ranks, n_ranks);
  return layout;
}

/// Traffic of the messages of a few steps, with these clocks.
Traffic traffic_with(const RankClocks& clocks, const Communicator& ranks)
{
  const PatchLayout layout = patch_on_each(ranks.size());
  const TaskGraph graph({pass_on()}, layout, {"only"}, {{&value}, {}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph}, ranks.rank());
  BoundGraph bound(graph, warehouse, ranks, &clocks);
  Schedule schedule(bound, 1);
  Executor executor(1, test::on_shared_cores());
  for (int n = 0; n < 5; ++n) {
    executor.run(schedule, {});
    warehouse.advance();
  }
  return bound.traffic();
}

/// Clocks of ranks, each a second behind that of the rank before.
constexpr std::uint64_t second = 3'000'000'000;
std::vector<ClockLine> each_behind_the_one_before(int n_ranks)
{
  std::vector<ClockLine> lines;
  lines.reserve(static_cast<std::size_t>(n_ranks));
  for (int rank = 0; rank < n_ranks; ++rank) {
    const ClockPair pair{1, 1 + static_cast<std::uint64_t>(rank) * second, 0};
    lines.emplace_back(pair, pair);
  }
  return lines;
}

}  // namespace

TEST_CASE("how long a message was on its way is told by one clock, whatever those of its ranks say", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();
  if (ranks.size() == 1) return;

  const Traffic traffic = traffic_with(RankClocks(each_behind_the_one_before(ranks.size())), ranks);

  // The clocks are the same in truth: what comes from a rank before seems a second late, what comes from one behind
  // as if it were here before it left.
  REQUIRE(traffic.n_messages > 0);
  if (ranks.rank() == 0) CHECK(traffic.under_way == 0);
  if (ranks.rank() > 0) CHECK(traffic.under_way >= 5 * second);
  CHECK(traffic.waited_for <= traffic.under_way);
}

TEST_CASE("ranks on one machine have the same clock", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();
  RankClocks clocks(ranks);
  clocks.follow(64);

  for (int rank = 0; rank < ranks.size(); ++rank) CHECK(clocks.first_rank(rank, 12'345'678) == 12'345'678);
}

}  // namespace tamp::runtime::test_rank_clocks
