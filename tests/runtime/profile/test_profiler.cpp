#include "runtime/profile/profiler.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "runtime/profile/report.hpp"
#include "runtime/profile/table.hpp"
#include "tests/runtime/heat.hpp"

namespace tamp::runtime::test_profiler
{

TEST_CASE("a quantile of durations is right to a bin", "[profile]")
{
  DurationHistogram histogram;
  for (std::uint64_t t = 1000; t <= 2000; ++t) histogram.add(t);

  CHECK(histogram.count() == 1001);
  CHECK(histogram.least() == 1000);
  CHECK(histogram.most() == 2000);
  CHECK(histogram.quantile(0.95) == Approx(1950).epsilon(0.02));
  CHECK(histogram.quantile(0.5) == Approx(1500).epsilon(0.02));
}

TEST_CASE("the profile counts every instance and its shares sum to one", "[profile]")
{
  test::Heat heat(16, {2, 2, 1}, 2);
  heat.run(10, 1e-4);

  const nlohmann::json json = to_json(heat.engine.profile(), heat.engine.warehouse().ledger());

  double shares = 0;
  std::uint64_t count = 0;
  for (const auto& t : json["tasks"]) {
    shares += t["share"].get<double>();
    count += t["count"].get<std::uint64_t>();
  }
  CHECK(shares == Approx(1).margin(1e-12));
  CHECK(count == 10 * heat.engine.graph().instances().size());
  CHECK(json["critical_path_s"].get<double>() <= json["step_s"].get<double>() * 1.001);
  CHECK(json["memory"]["total"] == heat.engine.warehouse().ledger().total().peak());
}

TEST_CASE("ranks, patches and parts of a run each sum up to what the tasks took", "[profile]")
{
  test::Heat heat(16, {2, 2, 1}, 2);
  heat.run(100, 1e-4);

  const Profile profile = heat.engine.profile();

  double all = 0, over_patches = 0, of_patches = 0, of_rank = 0, on_chains = 0;
  for (const TaskStatistics& t : profile.tasks) {
    all += t.total_s;
    double over_time = 0;
    for (std::size_t k = 0; k < t.over_time_s.size(); ++k) {
      const long last = profile.n_steps - profile.steps_each_part * static_cast<long>(k);
      over_time += t.over_time_s[k] * static_cast<double>(std::min(profile.steps_each_part, last));
    }
    CHECK(over_time == Approx(t.total_s));
    if (t.count >= 400) over_patches += t.total_s;
    CHECK(t.on_chain <= 1);
    on_chains += t.on_chain;
  }
  for (const PatchStatistics& patch : profile.patches) of_patches += patch.total_s;
  for (const TaskStatistics& t : profile.ranks.at(0).tasks) of_rank += t.total_s;
  CHECK(profile.steps_each_part == 2);
  CHECK(profile.step_over_time_s.size() == 50);
  CHECK(profile.patches.size() == 4);
  CHECK(of_patches == Approx(over_patches));
  CHECK(of_rank == Approx(all));
  // Each step has a longest chain, of one task at least.
  CHECK(on_chains >= 1);
}

TEST_CASE("each rank has its own numbers, and together they are those of the run", "[profile][ranks]")
{
  const Communicator world = Communicator::world();
  test::Heat heat(16, {4, 4, 1}, 2, world);
  heat.run(20, 1e-4);

  const Profile profile = heat.engine.profile();

  REQUIRE(profile.ranks.size() == static_cast<std::size_t>(world.size()));
  std::uint64_t of_ranks = 0, all = 0;
  for (const RankStatistics& rank : profile.ranks) {
    for (const TaskStatistics& t : rank.tasks) of_ranks += t.count;
    CHECK(rank.step_s > 0);
    CHECK(rank.step_s <= profile.step_s);
  }
  for (const TaskStatistics& t : profile.tasks) {
    all += t.count;
    CHECK(t.rank_imbalance >= 0.999);
    CHECK(t.rank_imbalance <= world.size() * 1.001);
  }
  CHECK(of_ranks == all);
  for (const PatchStatistics& patch : profile.patches) CHECK(patch.rank < world.size());
  const nlohmann::json json = to_json(profile, heat.engine.warehouse().ledger(), world);
  for (const auto& rank : json["ranks"]) CHECK(rank.at("between_s") > 0.0);
}

TEST_CASE("a step and what lies between two are those of one rank, so that they add up to the time that passed",
          "[profile][ranks]")
{
  const Communicator world = Communicator::world();
  test::Heat heat(16, {4, 4, 1}, 2, world);
  std::vector<int> owners(16);
  for (std::size_t p = 0; p < owners.size(); ++p) owners[p] = static_cast<int>(p) % world.size();
  heat.engine.deal(owners);
  heat.run(1, 1e-4);
  // Making the profile, and waiting for the other ranks, counts as time between two steps, too.
  const auto start = std::chrono::steady_clock::now();
  const Profile before = heat.engine.profile();

  // While the last rank's host is at something else the others wait for it within their steps.
  world.barrier();
  for (int step = 0; step < 40; ++step) {
    if (world.rank() == world.size() - 1) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    heat.run(1, 1e-4);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const Profile profile = heat.engine.profile();

  const double accounted = 41 * (profile.step_s + profile.between_s) - (before.step_s + before.between_s);
  CHECK(accounted < 1.2 * world.max(wall.count()) + 0.02);
  CHECK(accounted > 0.8 * 40 * 2e-3);
}

TEST_CASE("a profile whose workers were without their cores as tasks ran says that it is too busy to trust",
          "[profile]")
{
  const CellLabel<double, "rest"> rest;
  const auto profile_of = [&](int n_steps, bool sleeps) {
    const auto work = task("work").over_patches().computes(rest).body([sleeps](const TaskContext&, auto) {
      // Asleep a worker has no core, as when another program has it.
      if (sleeps) return std::this_thread::sleep_for(std::chrono::microseconds(200));
      const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(200);
      while (std::chrono::steady_clock::now() < end) continue;
    });
    const PatchLayout layout({2, {0, 0, 0}, 1, {4, 4, 1}}, {1, 1, 1});
    Executor executor(1);
    Engine engine(layout, {"all"}, {{{work}, {{}, {&rest}}}}, executor);
    for (int step = 0; step < n_steps; ++step) engine.advance(1);
    return to_json(engine.profile(), engine.warehouse().ledger());
  };

  const nlohmann::json asleep = profile_of(300, true), at_work = profile_of(300, false), brief = profile_of(100, true);

  CHECK(asleep.at("core_share") < 0.5);
  CHECK(asleep.at("too_busy") == true);
  CHECK_THAT(to_text(asleep), Catch::Contains("too busy to trust"));
  CHECK(at_work.at("core_share") > asleep.at("core_share"));
  CHECK(at_work.at("core_share") <= 1);
  CHECK_FALSE(brief.contains("core_share"));
}

TEST_CASE("the ledger knows the bytes of each label", "[profile]")
{
  test::Heat heat(16, {2, 2, 1}, 1);
  std::size_t bytes = 0;
  for (const LedgerEntry& entry : heat.engine.warehouse().ledger().entries()) {
    if (entry.name() == "temperature") bytes = entry.peak();
  }

  // Four patches of 8 x 8 cells with one layer of halo, before and after the step.
  CHECK(bytes == 4 * 10 * 10 * sizeof(double) * 2);
}

TEST_CASE("the table has what part of the memory's rate a task takes, where that is known", "[profile]")
{
  test::Heat heat(16, {2, 2, 1}, 1);
  heat.run(10, 1e-4);
  nlohmann::json json = to_json(heat.engine.profile(), heat.engine.warehouse().ledger());
  nlohmann::json& task = json["tasks"][0];
  task["total_s"] = 2;
  task["bytes"] = 6e9;

  const std::string known = to_text(json, {.memory_rate = 12e9}), unknown = to_text(json);

  CHECK_THAT(known, Catch::Contains("of mem") && Catch::Contains(" 25%") && Catch::Contains("12.0 GB/s to a worker"));
  CHECK_THAT(unknown, !Catch::Contains("of mem") && !Catch::Contains("to a worker"));
  CHECK_THAT(unknown,
             Catch::Contains("gain if free\n") && Catch::Contains("\nimbalance: costliest patch over the mean; "));
}

}  // namespace tamp::runtime::test_profiler
