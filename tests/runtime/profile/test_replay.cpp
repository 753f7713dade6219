#include "runtime/profile/replay.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "runtime/graph/task_graph.hpp"
#include "tests/runtime/heat.hpp"

namespace tamp::runtime::test_replay
{

namespace
{

const CellLabel<double, "first"> first;
const CellLabel<double, "second"> second;

PatchLayout row(int n_patches, int n_ranks = 1)
{
  PatchLayout layout({2, {0, 0, 0}, 1, {3 * n_patches, 3, 1}}, {n_patches, 1, 1});
  std::vector<int> ranks;
  ranks.reserve(static_cast<std::size_t>(n_patches));
  for (int p = 0; p < n_patches; ++p) ranks.push_back(p * n_ranks / n_patches);
  layout.give_to_ranks(ranks, n_ranks);
  return layout;
}

TaskDeclaration make()
{
  return task("make").over_patches_and_groups().computes(first).body([](const TaskContext&, auto) {});
}

TaskDeclaration use(int halo)
{
  return task("use")
      .over_patches_and_groups()
      .reads(first.halo(halo))
      .computes(second)
      .body([](const TaskContext&, auto) {});
}

/// A step in which only bodies take time: as many seconds as `seconds` says for a task on a patch.
template <class Seconds>
TimedStep timed(const TaskGraph& graph, const Seconds& seconds, double message_s = 0)
{
  TimedStep step{&graph, {}, std::vector<double>(graph.messages().size(), message_s)};
  for (const Instance& instance : graph.instances()) {
    step.instance_s.push_back(instance.kind == InstanceKind::body ? seconds(graph.name(instance), instance.patch)
                                                                  : 0.0);
  }
  return step;
}

double of_patch(const std::string&, int patch)
{
  return patch == 0 ? 3 : 1;
}

}  // namespace

TEST_CASE("a replayed step takes as long as its tasks on one worker, and no less than its chain on many", "[profile]")
{
  const PatchLayout layout = row(1);
  const TaskGraph graph({make(), use(0)}, layout, {"only"}, {{}, {&second}});
  const TimedStep step = timed(graph, [](const std::string& name, int) { return name == "make" ? 2 : 5; });

  CHECK(replay(step, 1) == 7);
  CHECK(replay(step, 8) == 7);
  CHECK(longest_chain(step).length_s == 7);
  CHECK(longest_chain(step).instances == std::vector<int>{0, 1});
}

TEST_CASE("workers share what does not wait, and an idle one takes from another", "[profile]")
{
  const PatchLayout layout = row(3);
  const TaskGraph graph({make()}, layout, {"only"}, {{}, {&first}});
  const TimedStep step = timed(graph, of_patch);

  CHECK(replay(step, 1) == 5);
  // The second patch is the first worker's, who has three seconds to go.
  CHECK(replay(step, 2) == 3);
  CHECK(longest_chain(step).length_s == 3);
}

TEST_CASE("what waits for a neighbour waits for its message too", "[profile]")
{
  const PatchLayout layout = row(2, 2);
  const TaskGraph graph({make(), use(1)}, layout, {"only"}, {{}, {&second}});
  REQUIRE(graph.messages().size() == 2);
  const TimedStep step = timed(graph, of_patch, 0.5);

  // The second rank uses the first one's values after 3.5 s.
  CHECK(replay(step, 1) == 6);
  CHECK(replay(step, 4) == 6);
  CHECK(longest_chain(step).length_s == 6);
  const TimedStep alone = timed(
      graph, [](const std::string&, int patch) { return patch == 0 ? 0 : 1; }, 0.5);
  CHECK(longest_chain(alone).length_s == 2);
  // A message of 5 s is on the chain.
  const Chain chain = longest_chain(timed(graph, of_patch, 5));
  CHECK(std::count_if(chain.message_s.begin(), chain.message_s.end(), [](double s) { return s == 5; }) == 1);
  CHECK(std::accumulate(chain.message_s.begin(), chain.message_s.end(), 0.0) == 5);
  CHECK(chain.message_s.size() == chain.instances.size());
}

/// Time of all links of a chain, with the messages before them [s].
double length_of(const std::vector<ChainLink>& chain)
{
  double sum = 0;
  for (const ChainLink& link : chain) sum += link.message_s + link.task_s;
  return sum;
}

TEST_CASE("on one worker a step gains what a task takes, and a tenth of it", "[profile]")
{
  test::Heat heat(16, {2, 2, 1}, 1);
  heat.run(20, 1e-4);

  const Profile profile = heat.engine.profile();

  double all = 0, on_chain = 0;
  for (const TaskStatistics& t : profile.tasks) {
    CHECK(t.gain_of_all == Approx(t.share).margin(1e-9));
    CHECK(t.gain_of_tenth == Approx(0.1 * t.share).margin(1e-9));
    all += t.total_s;
    on_chain += t.chain_s;
  }
  CHECK(profile.replayed_s * 20 == Approx(all).epsilon(1e-3));
  CHECK(on_chain == Approx(profile.longest_chain_s));
  CHECK(length_of(profile.chain) == Approx(profile.longest_chain_s));
  CHECK(profile.longest_chain_s <= profile.replayed_s);
  CHECK(profile.replayed_s <= profile.step_s);
}

TEST_CASE("a step is forecast to be longer with a slower task and shorter with a faster one, by its share", "[profile]")
{
  test::Heat heat(16, {2, 2, 1}, 1);
  heat.run(20, 1e-4);

  const auto tasks = heat.engine.profile().tasks;
  const auto diffuse = std::ranges::find(tasks, "diffuse", &TaskStatistics::name);

  REQUIRE(diffuse != tasks.end());
  CHECK(heat.engine.step_ratio("diffuse", 1.5) == Approx(1 + 0.5 * diffuse->share));
  CHECK(heat.engine.step_ratio("diffuse", 0.5) == Approx(1 - 0.5 * diffuse->share));
  CHECK(heat.engine.step_ratio("no such task", 1.5) == 1);
}

TEST_CASE("a chain through ranks is no longer than the step", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();
  test::Heat heat(24, {4, 3, 1}, 1, ranks);
  std::vector<int> turned;
  for (const Patch& patch : heat.engine.layout()) turned.push_back(patch.id % ranks.size());
  heat.engine.deal(turned);
  heat.run(50, 1e-4);

  const Profile profile = heat.engine.profile();

  if (!ranks.is_first()) return;
  CHECK(profile.longest_chain_s > 0);
  CHECK(length_of(profile.chain) == Approx(profile.longest_chain_s));
  CHECK(profile.longest_chain_s <= profile.replayed_s * (1 + 1e-9));
}

}  // namespace tamp::runtime::test_replay
