#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/profile/profiler.hpp"
#include "tests/runtime/shared_cores.hpp"

namespace tamp::runtime::test_sparse
{

namespace
{

using Point = std::array<double, 2>;

struct Highest {
  double value = -1;

  static constexpr auto fields = std::tuple{Greatest{&Highest::value}};
};

const ParticleLabel<Point, "place"> place;
const NodeLabel<double, "mass"> mass;
const NodeLabel<double, "speed"> speed;
const ReductionLabel<Highest, "greatest"> greatest;

constexpr int n_patches = 8;
constexpr int cells_per_patch = 3;

/// Two groups that drift along a row of patches, towards each other; what they give to the nodes depends on the step.
struct Row {
  Row(bool sparse, int n_threads)
      : all(Communicator::world()),
        layout(row(all.size())),
        graph(tasks(sparse), layout, {"right", "left"}, {{&place}, {&mass, &speed, &greatest}}),
        warehouse(std::vector<const TaskGraph*>{&graph}, all.rank()),
        bound(graph, warehouse, all),
        schedule(bound, n_threads),
        executor(n_threads, test::on_shared_cores())
  {
    add(0, 0.5);
    add(1, n_patches * cells_per_patch - 0.5);
  }

  static PatchLayout row(int n_ranks)
  {
    PatchLayout layout({2, {0, 0, 0}, 1, {n_patches * cells_per_patch, 3, 1}}, {n_patches, 1, 1});
    std::vector<int> ranks = layout.ranks();
    for (std::size_t p = 0; p < ranks.size(); ++p) ranks[p] = static_cast<int>(p) % n_ranks;
    layout.give_to_ranks(ranks, n_ranks);
    return layout;
  }

  void add(int group, double x)
  {
    const int patch = layout.patch_of_cell({static_cast<int>(x), 1, 0});
    if (!warehouse.is_local(layout[patch])) return;
    warehouse.set_n_particles(patch, group, 1);
    warehouse.state(place, patch, group)[0] = {x, 1.5};
  }

  std::vector<TaskDeclaration> tasks(bool sparse)
  {
    auto give = task("give")
                    .over_patches_and_groups()
                    .reads(place.previous())
                    .accumulates(mass.halo(1))
                    .body([this](const TaskContext& at, auto data) {
                      const auto places = data[place.previous()];
                      const auto nodes = data[mass];
                      ++n_given[static_cast<std::size_t>(at.patch.id)];
                      for (const Point& x : places) {
                        const auto i = static_cast<int>(x[0]);
                        nodes[{i, 1, 0}] += 0.1 * static_cast<double>(1 + at.step.index);
                        nodes[{i + 1, 1, 0}] += 0.3;
                      }
                    });
    auto move = task("move")
                    .over_patches_and_groups()
                    .reads(mass.halo(1))
                    .computes(speed.halo(1))
                    .body([](const TaskContext&, auto data) {
                      const auto nodes = data[mass];
                      const auto speeds = data[speed];
                      for_each(nodes.box(), [&](const Index& i) { speeds[i] = 3 * nodes[i]; });
                    });
    auto meet = task("meet")
                    .over_patches()
                    .updates(speed.halo(1).every_group())
                    .reduces(greatest)
                    .body([this](const TaskContext& at, auto data) {
                      const auto speeds = data[speed];
                      Highest& most = data[greatest];
                      ++n_met[static_cast<std::size_t>(at.patch.id)];
                      for_each(speeds[0].box(), [&](const Index& i) {
                        const double sum = speeds[0][i] + speeds[1][i];
                        if (sum > 0) most.value = std::max(most.value, sum);
                        speeds[0][i] = speeds[1][i] = sum;
                      });
                    });
    auto drift = task("drift")
                     .over_patches_and_groups()
                     .reads(place.previous())
                     .computes(place)
                     .body([](const TaskContext& at, auto data) {
                       const auto old = data[place.previous()];
                       const auto now = data[place];
                       const double dx = at.group == 0 ? 1.3 : -1.3;
                       for (std::size_t p = 0; p < old.size(); ++p) now[p] = {old[p][0] + dx, old[p][1]};
                     });
    for (TaskDeclaration* t : {&give, &move, &meet}) t->sparsity = sparse ? Sparsity::no_particles : Sparsity::none;
    return {give, move, meet, drift, migration(place)};
  }

  void step(long index)
  {
    for (auto* counts : {&n_given, &n_met}) {
      for (auto& count : *counts) count = 0;
    }
    executor.run(schedule, {index, 0, 1, 1});
    warehouse.advance();
  }

  /// All that the step left on nodes of this rank's patches and their halos, and the whole reduction.
  std::vector<double> results()
  {
    std::vector<double> values{warehouse.result(greatest).value};
    for (const Patch& patch : layout) {
      if (!warehouse.is_local(patch)) continue;
      for (int group = 0; group < 2; ++group) {
        for (const GridView<const double>& view :
             {warehouse.grid_result(mass, patch.id, group), warehouse.grid_result(speed, patch.id, group)}) {
          for_each(view.box(), [&](const Index& i) { values.push_back(view[i]); });
        }
      }
    }
    return values;
  }

  Communicator all;
  std::array<std::atomic<int>, n_patches> n_given{}, n_met{};
  PatchLayout layout;
  TaskGraph graph;
  Warehouse warehouse;
  BoundGraph bound;
  Schedule schedule;
  Executor executor;
};

}  // namespace

TEST_CASE("a sparse task runs where there are particles, or where they gave to nodes, and nowhere else", "[ranks]")
{
  Row row(true, 2);

  row.step(0);

  for (const Patch& patch : row.layout) {
    if (!row.warehouse.is_local(patch)) continue;
    const auto p = static_cast<std::size_t>(patch.id);
    const bool occupied = patch.id == 0 || patch.id == n_patches - 1;
    const bool beside = patch.id == 1 || patch.id == n_patches - 2;
    CHECK(row.n_given[p] == (occupied ? 1 : 0));
    CHECK(row.n_met[p] == (occupied || beside ? 1 : 0));
  }
}

TEST_CASE("particles that wander through sleeping patches leave the same bits as if all patches were awake", "[ranks]")
{
  const int n_threads = GENERATE(1, 2, 3);
  Row sparse(true, n_threads), full(false, n_threads);

  int n_skipped = 0;
  // They meet in the middle, and leave at the other end.
  for (long n = 0; n < 22; ++n) {
    sparse.step(n);
    full.step(n);
    REQUIRE(sparse.results() == full.results());
    for (const Patch& patch : sparse.layout) {
      const auto p = static_cast<std::size_t>(patch.id);
      if (sparse.warehouse.is_local(patch) && sparse.n_met[p] == 0) ++n_skipped;
    }
  }

  CHECK(n_skipped > 0);
  // All have gone, and nothing is left.
  CHECK(sparse.warehouse.result(greatest).value == -1);
  for (const auto& count : sparse.n_given) CHECK(count == 0);
}

TEST_CASE("a sparse task whose halo is filled from neighbours runs everywhere", "[ranks]")
{
  const Communicator all = Communicator::world();
  const PatchLayout layout = Row::row(all.size());
  const NodeLabel<double, "one"> one;
  const NodeLabel<double, "other"> other;
  std::atomic<int> n_made{0}, n_used{0};
  auto make =
      task("make").over_patches_and_groups().sparse().computes(one).body([&](const TaskContext&, auto) { ++n_made; });
  auto use = task("use")
                 .over_patches_and_groups()
                 .sparse()
                 .reads(one.halo(1))
                 .computes(other)
                 .body([&](const TaskContext&, auto) { ++n_used; });
  const TaskGraph graph({make, use}, layout, {"only"}, {{}, {&other}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph}, all.rank());
  BoundGraph bound(graph, warehouse, all);
  Schedule schedule(bound, 1);

  Executor(1).run(schedule, {});

  CHECK(n_made == 0);
  const std::vector<int> ranks = layout.ranks();
  CHECK(n_used == std::count(ranks.begin(), ranks.end(), all.rank()));
}

TEST_CASE("tasks that need a pair of groups, or what such a task made, run nowhere else")
{
  const PatchLayout layout = Row::row(1);
  const NodeLabel<double, "level"> level;
  const NodeLabel<double, "gap"> gap;
  const NodeLabel<double, "sum"> sum;
  std::atomic<int> n_met{0}, n_added{0};
  auto rise = task("rise")
                  .over_patches_and_groups()
                  .sparse()
                  .reads(place.previous())
                  .computes(level)
                  .body([&](const TaskContext&, auto data) {
                    const auto levels = data[level];
                    for_each(levels.box(), [&](const Index& i) { levels[i] = 1; });
                  });
  auto meet = task("meet")
                  .over_patches()
                  .sparse(Sparsity::no_pair)
                  .updates(level.every_group())
                  .computes(gap.every_group())
                  .body([&](const TaskContext&, auto data) {
                    ++n_met;
                    const auto levels = data[level];
                    const auto gaps = data[gap];
                    for (std::size_t g = 0; g < 2; ++g) {
                      for_each(levels[g].box(), [&](const Index& i) { gaps[g][i] = levels[g][i] += 1; });
                    }
                  });
  auto add = task("add")
                 .over_patches_and_groups()
                 .sparse(Sparsity::no_fields)
                 .reads(gap, place.previous())
                 .computes(sum)
                 .body([&](const TaskContext&, auto data) {
                   ++n_added;
                   const auto gaps = data[gap];
                   const auto sums = data[sum];
                   for_each(sums.box(), [&](const Index& i) { sums[i] = gaps[i]; });
                 });
  const TaskGraph graph({rise, meet, add}, layout, {"one", "other"}, {{&place}, {&level, &sum}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph});
  BoundGraph bound(graph, warehouse);
  Schedule schedule(bound, 1);
  const int alone = 1, both = 4;
  for (const auto& [patch, group] : {std::pair{alone, 0}, {both, 0}, {both, 1}}) {
    warehouse.set_n_particles(patch, group, 1);
  }

  Executor(1).run(schedule, {});

  CHECK(n_met == 1);
  CHECK(n_added == 2);
  const auto at = [&](const auto& label, int patch) {
    return warehouse.grid_result(label, patch, 0)[{patch * cells_per_patch, 1, 0}];
  };
  CHECK(at(level, alone) == 1);
  CHECK(at(sum, alone) == 0);
  CHECK(at(level, both) == 2);
  CHECK(at(sum, both) == 2);
}

TEST_CASE("state that the host sets is never taken for zero")
{
  const PatchLayout layout = Row::row(1);
  const NodeLabel<double, "level"> level;
  auto fall = task("fall")
                  .over_patches_and_groups()
                  .sparse()
                  .reads(level.previous())
                  .computes(level)
                  .body([&](const TaskContext& at, auto data) {
                    const auto old = data[level.previous()];
                    const auto now = data[level];
                    for_each(at.patch.nodes, [&](const Index& i) { now[i] = old[i] / 2; });
                  });
  const TaskGraph graph({fall}, layout, {"only"}, {{&level}, {}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph});
  BoundGraph bound(graph, warehouse);
  Schedule schedule(bound, 1);
  Executor executor(1);
  warehouse.grid_state(level, 3, 0)[{10, 1, 0}] = 8;

  for (int n = 0; n < 3; ++n) {
    executor.run(schedule, {});
    warehouse.advance();
  }

  CHECK(warehouse.grid_state(level, 3, 0)[{10, 1, 0}] == 1);
}

TEST_CASE("the profile counts skipped instances apart")
{
  Row row(true, 1);
  Profiler profiler(row.schedule, row.bound, 1);

  row.step(0);
  profiler.add_step();

  const Profile profile = profiler.profile();
  const auto statistics = [&](const std::string& name) {
    return *std::find_if(profile.tasks.begin(), profile.tasks.end(),
                         [&](const TaskStatistics& t) { return t.name == name; });
  };
  CHECK(statistics("give").count == 2);
  CHECK(statistics("give").skipped == 2 * n_patches - 2);
  CHECK(statistics("sum halo: give").count == 4);
  CHECK(statistics("meet").count == 4);
  CHECK(statistics("meet").skipped == n_patches - 4);
  CHECK(statistics("drift").skipped == 0);
}

TEST_CASE("a task that was always skipped is in the profile with zeros")
{
  Row row(true, 1);
  for (const Patch& patch : row.layout) {
    for (int group = 0; group < 2; ++group) row.warehouse.set_n_particles(patch.id, group, 0);
  }
  Profiler profiler(row.schedule, row.bound, 1);

  row.step(0);
  profiler.add_step();

  const Profile profile = profiler.profile();
  const auto give = std::find_if(profile.tasks.begin(), profile.tasks.end(),
                                 [](const TaskStatistics& t) { return t.name == "give"; });
  REQUIRE(give != profile.tasks.end());
  CHECK(give->skipped == 2 * n_patches);
  for (const double zero : {give->total_s, give->mean_s, give->min_s, give->max_s, give->p95_s, give->share}) {
    CHECK(zero == 0);
  }
}

}  // namespace tamp::runtime::test_sparse
