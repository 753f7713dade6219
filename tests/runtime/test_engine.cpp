#include "runtime/engine.hpp"

#include <catch2/catch.hpp>

#include <numeric>

#include "runtime/graph/graph_error.hpp"
#include "runtime/graph/step_verdict.hpp"
#include "runtime/step_error.hpp"
#include "runtime/storage/fields/field_copy.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tests/runtime/heat.hpp"

namespace tamp::test::test_engine
{

namespace
{

constexpr double dt = 1e-4;

Heat plate(const Communicator& ranks, int n_threads = 2)
{
  return Heat(24, {4, 3, 1}, n_threads, ranks);
}

/// All that runs are compared by.
std::vector<double> all_of(Heat& heat)
{
  std::vector<double> all = heat.values();
  const Progress& progress = heat.engine.progress();
  all.insert(all.end(), {heat.engine.warehouse().total(Heat::total), static_cast<double>(progress.n_steps),
                         progress.time, progress.step_size});
  return all;
}

std::vector<double> alone(int n_steps)
{
  Heat heat = plate({}, 1);
  heat.run(n_steps, dt);
  return all_of(heat);
}

}  // namespace

TEST_CASE("the last step is as long as it takes to the end", "[engine]")
{
  Heat heat = plate({});

  while (heat.engine.progress().time < 2.5 * dt) heat.engine.advance(dt, 2.5 * dt);

  CHECK(heat.engine.progress().time == 2.5 * dt);
  CHECK(heat.engine.progress().n_steps == 3);
  CHECK(heat.engine.progress().step_size == Approx(0.5 * dt));
}

TEST_CASE("a layout that is dealt to other ranks than the communicator's is refused wherever the two meet",
          "[engine][ranks]")
{
  const Communicator ranks = Communicator::world();
  const Grid grid{2, {0, 0, 0}, 0.25, {4, 4, 1}};
  PatchLayout layout(grid, {2, 2, 1});
  layout.give_to_ranks({ranks.size(), 0, 0, ranks.size()}, ranks.size() + 1);
  const TaskList tasks{Heat::diffusion(grid)};
  const HostData host{{&temperature, &Heat::total}, {}};
  Executor executor(1, on_shared_cores());
  const TaskGraph graph(tasks, layout, {"heat"}, host);
  const std::vector<const TaskGraph*> graphs{&graph};
  Warehouse warehouse(graphs, ranks.rank());
  const TemporaryFolder folder(ranks);

  CHECK_THROWS_AS(Engine(layout, {"heat"}, {{tasks, host}}, executor, ranks), GraphError);
  CHECK_THROWS_AS(BoundGraph(graph, warehouse, ranks), GraphError);
  CHECK_THROWS_AS(warehouse.deal(graphs, ranks), GraphError);
  CHECK_THROWS_AS(write_checkpoint(folder.path(), {}, {}, warehouse, {"heat"}, 1, ranks), GraphError);
  CHECK_THROWS_AS(read_checkpoint({}, warehouse, {"heat"}, ranks), GraphError);
  CHECK_THROWS_AS(gathered(FieldCopy{}, layout, ranks), GraphError);
  CHECK_THROWS_AS(particles_by_patch(warehouse, 0, ranks), GraphError);
  CHECK_THROWS_WITH(expect_ranks(layout, ranks.size()),
                    Catch::Contains("layout on other ranks: its patches are dealt to " +
                                    std::to_string(ranks.size() + 1) + " ranks"));
}

TEST_CASE("patches are given to each of the ranks that there are, and to no others", "[engine]")
{
  PatchLayout layout({2, {0, 0, 0}, 1, {4, 4, 1}}, {2, 2, 1});
  Heat heat = plate({});

  CHECK_THROWS_AS(layout.give_to_ranks({0, 1, 0}, 2), std::invalid_argument);
  CHECK_THROWS_AS(layout.give_to_ranks({0, 1, 0, 2}, 2), std::invalid_argument);
  CHECK_THROWS_AS(layout.give_to_ranks({0, -1, 0, 1}, 2), std::invalid_argument);
  CHECK_THROWS_AS(heat.engine.deal(std::vector<int>(12, 1)), std::invalid_argument);
  CHECK(layout.n_ranks() == 1);
  heat.run(1, dt);
  CHECK(heat.engine.progress().n_steps == 1);
}

TEST_CASE("what a rank without patches asks for is heard by all, once, as is what the others ask for",
          "[engine][ranks]")
{
  const Communicator ranks = Communicator::world();
  // The first rank has all patches.
  Heat heat = plate(ranks);
  const unsigned own = 1U << static_cast<unsigned>(ranks.rank()), all = (1U << static_cast<unsigned>(ranks.size())) - 1;
  heat.run(1, dt);

  heat.engine.ask(own);
  unsigned heard = 0;
  int n_heard = 0;
  for (int step = 0; step < 24; ++step) {
    heat.run(1, dt);
    heard |= heat.engine.asked();
    n_heard += int{(heat.engine.asked() & (1U << static_cast<unsigned>(ranks.size() - 1))) != 0};
  }

  CHECK(heard == all);
  CHECK(n_heard == 1);
}

TEST_CASE("patches that follow the load to other ranks take all along", "[engine][ranks]")
{
  Heat heat = plate(Communicator::world());
  heat.engine.balance_every(7);

  heat.run(20, dt);

  CHECK(all_of(heat) == alone(20));
  const bool several = Communicator::world().size() > 1;
  CHECK(heat.engine.rebalances().empty() != several);
  for (const Rebalance& deal : heat.engine.rebalances()) CHECK(deal.imbalance_expected < deal.imbalance_before);
  CHECK(heat.engine.profile().n_steps == 20);
}

TEST_CASE("patches that are dealt to other ranks between steps change nothing", "[engine][ranks]")
{
  const Communicator ranks = Communicator::world();
  Heat heat = plate(ranks);
  heat.run(8, dt);
  std::vector<int> turned;
  for (const Patch& patch : heat.engine.layout()) turned.push_back((patch.rank + 1 + patch.id / 5) % ranks.size());

  heat.engine.deal(turned);
  heat.run(6, dt);
  heat.engine.deal(std::vector<int>(turned.size(), ranks.size() - 1));
  heat.run(6, dt);

  CHECK(all_of(heat) == alone(20));
}

TEST_CASE("a deal holds no more than what it moves beside what stays", "[engine][ranks]")
{
  const Communicator ranks = Communicator::world();
  Heat heat = plate(ranks);
  heat.run(3, dt);
  const LedgerEntry& held = heat.engine.warehouse().ledger().entry("temperature");
  const std::size_t peak = held.peak(), before = held.current();
  const std::vector<int> of_first = heat.engine.layout().ranks();
  std::vector<int> most_to_last(of_first.size(), ranks.size() - 1);
  most_to_last.front() = 0;

  heat.engine.deal(most_to_last);
  const std::size_t shared = held.current();
  heat.engine.deal(of_first);

  // The first rank gives patches away and gets them back.
  if (ranks.is_first()) {
    CHECK((shared < before) == (ranks.size() > 1));
    CHECK(held.peak() == peak);
  }
  CHECK(held.current() == before);
  CHECK(all_of(heat) == alone(3));
}

TEST_CASE("an engine goes on from a checkpoint to the same bits, however patches are dealt", "[engine][ranks]")
{
  const Communicator ranks = Communicator::world();
  const TemporaryFolder folder(ranks);
  const std::vector<std::byte> own{std::byte{1}, std::byte{2}};
  {
    Heat heat = plate(ranks);
    heat.run(12, dt);
    heat.engine.write_checkpoint(folder.path(), "plate", own, 1);
  }
  Heat heat = plate(ranks, 1);
  heat.engine.balance_every(5);
  heat.run(6, dt);
  std::vector<std::string> refused;

  CHECK(heat.engine.restart(newest_checkpoint(folder.path(), refused, ranks).value()) == own);
  heat.run(8, dt);

  CHECK(all_of(heat) == alone(20));
}

TEST_CASE("what one rank asks for, all hear with the next step and once", "[engine][ranks]")
{
  const Communicator ranks = Communicator::world();
  Heat heat = plate(ranks);

  // The first rank, which has all patches.
  if (ranks.is_first()) heat.engine.ask(4);
  heat.run(1, dt);
  CHECK(heat.engine.asked() == 4);
  heat.run(1, dt);
  CHECK(heat.engine.asked() == 0);
}

TEST_CASE("a step that a state does not allow is the same error on all ranks, and leaves the state", "[engine][ranks]")
{
  const Communicator ranks = Communicator::world();
  const ReductionLabel<double, "steam"> steam;
  const GlobalLabel<double, "pressure"> pressure;
  const auto boil =
      task("boil").over_patches().reduces(steam).body([&](const TaskContext&, auto data) { data[steam] = 0.25; });
  const auto burst = task("burst")
                         .over_ranks()
                         .reads(steam, pressure.previous())
                         .computes(pressure)
                         .body([&](const TaskContext& at, auto data) {
                           data[pressure] = data[pressure.previous()] + data[steam];
                           if (data[pressure] > 3) throw StepError("burst in step " + std::to_string(at.step.index));
                         });
  PatchLayout layout({2, {0, 0, 0}, 1, {4, 4, 1}}, {2, 2, 1});
  layout.give_to_ranks({0, 1 % ranks.size(), 2 % ranks.size(), 3 % ranks.size()}, ranks.size());
  Executor executor(2, on_shared_cores());
  Engine engine(layout, {"all"}, {{{boil, burst}, {{&pressure}, {}}}}, executor, ranks);
  for (int n = 0; n < 3; ++n) engine.advance(1);

  CHECK_THROWS_MATCHES(engine.advance(1), StepError, Catch::Message("burst in step 3"));

  CHECK(engine.progress().n_steps == 3);
  CHECK(engine.warehouse().global_state(pressure) == 3);
}

TEST_CASE("a step that refuses itself moves no particle and leaves the state, on all ranks, and may be tried again",
          "[engine][ranks]")
{
  using Point = std::array<double, 2>;
  const Communicator ranks = Communicator::world();
  const ParticleLabel<Point, "position"> position;
  const ReductionLabel<double, "way"> way;
  const GlobalLabel<double, "drift"> drift;
  const auto move = task("move")
                        .over_patches_and_groups()
                        .reads(position.previous())
                        .computes(position)
                        .reduces(way)
                        .body([&](const TaskContext& at, auto data) {
                          const auto old = data[position.previous()];
                          for (std::size_t p = 0; p < old.size(); ++p) {
                            data[position][p] = {old[p][0] + at.step.size, old[p][1]};
                            data[way] += at.step.size;
                          }
                        });
  const auto judge = task("judge")
                         .over_ranks()
                         .reads(way, drift.previous())
                         .computes(drift, step_verdict)
                         .body([&](const TaskContext& at, auto data) {
                           data[drift] = data[drift.previous()] + data[way];
                           data[step_verdict].refused = at.step.size > 1;
                         });
  PatchLayout layout({2, {0, 0, 0}, 1, {8, 4, 1}}, {4, 2, 1});
  std::vector<int> owners(8);
  for (int p = 0; p < 8; ++p) owners[static_cast<std::size_t>(p)] = p % ranks.size();
  layout.give_to_ranks(owners, ranks.size());
  Executor executor(2, on_shared_cores());
  Engine engine(layout, {"all"}, {{{move, judge, migration(position, step_verdict)}, {{&position, &way, &drift}, {}}}},
                executor, ranks);
  Warehouse& warehouse = engine.warehouse();
  for (const Patch& patch : engine.layout()) {
    if (!warehouse.is_local(patch)) continue;
    warehouse.set_n_particles(patch.id, 0, 1);
    warehouse.state(position, patch.id, 0)[0] = {patch.cells.lower[0] + 0.5, patch.cells.lower[1] + 0.5};
  }
  // Once a particle has gone over, what it was sent in stays in its patch's outbox.
  for (int n = 0; n < 2; ++n) CHECK(engine.advance(0.9));
  engine.ask(2);

  CHECK_FALSE(engine.advance(1.9));

  CHECK(engine.progress().n_steps == 2);
  CHECK(warehouse.total(way) == Approx(2 * 8 * 0.9));
  CHECK(warehouse.global_state(drift) == warehouse.total(way));
  const auto places = [&] {
    double sum = 0;
    std::size_t n = 0;
    for (const Patch& patch : engine.layout()) {
      if (!warehouse.is_local(patch)) continue;
      n += warehouse.n_particles(patch.id, 0);
      for (const Point& x : warehouse.state(position, patch.id, 0)) {
        sum += x[0];
        CHECK(x[0] >= patch.cells.lower[0]);
        CHECK(x[0] < patch.cells.upper[0]);
      }
    }
    const std::vector<double> sums = ranks.gather_value(sum);
    return std::pair{ranks.sum(n), std::accumulate(sums.begin(), sums.end(), 0.0)};
  };
  // The particles of the last patches along x have left the grid.
  CHECK(places().first == 6);
  CHECK(places().second == Approx(2 * (0.5 + 2.5 + 4.5) + 6 * 1.8));

  CHECK(engine.advance(0.1));

  CHECK(engine.asked() == 2);
  CHECK(places().first == 6);
  CHECK(places().second == Approx(2 * (0.5 + 2.5 + 4.5) + 6 * 1.9));
}

}  // namespace tamp::test::test_engine
