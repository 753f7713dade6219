#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/grid/curve_order.hpp"
#include "runtime/ranks/deal_patches.hpp"
#include "tests/runtime/shared_cores.hpp"

namespace tamp::runtime::test_ranks
{

namespace
{

using Point = std::array<double, 2>;

const ParticleLabel<Point, "place"> place;
const ParticleLabel<double, "warmth"> warmth;
const NodeLabel<double, "heat"> heat;
const CellLabel<double, "smooth"> smooth;
const CellLabel<double, "edges"> edges;
const CellLabel<double, "smoother"> smoother;

const ReductionLabel<double, "total"> total;
/// Globals that every rank computes: a trace of all totals so far, and the same as the step begins.
const GlobalLabel<double, "trace"> trace;
const GlobalLabel<double, "old trace"> old_trace;

/// The cells of which a task may know: where the grid is periodic, those beyond its ends too.
IndexBox seen_cells(const Grid& grid)
{
  IndexBox cells = grid.cells();
  for (std::size_t k = 0; k < 3; ++k) {
    cells.lower[k] -= grid.periodic[k] ? 1 : 0;
    cells.upper[k] += grid.periodic[k] ? 1 : 0;
  }
  return cells;
}

TaskDeclaration warm()
{
  return task("warm")
      .over_patches_and_groups()
      .reads(place.previous(), warmth.previous())
      .accumulates(heat.halo(1))
      .body([](const TaskContext&, auto data) {
        const auto x = data[place.previous()];
        const auto w = data[warmth.previous()];
        const auto h = data[heat];
        for (std::size_t p = 0; p < x.size(); ++p) {
          const Index cell{static_cast<int>(x[p][0]), static_cast<int>(x[p][1]), 0};
          for_each(IndexBox{{cell[0] - 1, cell[1] - 1, 0}, {cell[0] + 2, cell[1] + 2, 1}},
                   [&](const Index& i) { h[i] += w[p] / (1 + std::hypot(x[p][0] - i[0], x[p][1] - i[1])); });
        }
      });
}

TaskDeclaration chill()
{
  return task("chill")
      .over_patches_and_groups()
      .reads(smooth.previous())
      .accumulates(heat.halo(1))
      .body([](const TaskContext& at, auto data) {
        const auto old = data[smooth.previous()];
        const auto h = data[heat];
        for_each(at.patch.cells, [&](const Index& i) { h[i] -= 0.01 * old[i] * (1 + h[i]); });
      });
}

TaskDeclaration average()
{
  return task("average")
      .over_patches_and_groups()
      .reads(heat.halo(1), smooth.previous().halo(1))
      .computes(smooth)
      .body([](const TaskContext& at, auto data) {
        const auto h = data[heat];
        const auto old = data[smooth.previous()];
        const auto now = data[smooth];
        const IndexBox all = seen_cells(at.layout.grid());
        for_each(at.patch.cells, [&](const Index& i) {
          double sum = h[i] + h[{i[0] + 1, i[1] + 1, 0}];
          for_each(intersection(grown(IndexBox{i, {i[0] + 1, i[1] + 1, 1}}, 1, 2), all),
                   [&](const Index& j) { sum += 0.1 * old[j]; });
          now[i] = sum / 3;
        });
      });
}

/// Changes values that have been sent, where they came from, in the same step.
TaskDeclaration sharpen()
{
  return task("sharpen")
      .over_patches_and_groups()
      .reads(edges, smoother)
      .updates(smooth)
      .body([](const TaskContext& at, auto data) {
        const auto e = data[edges];
        const auto t = data[smoother];
        const auto s = data[smooth];
        for_each(at.patch.cells, [&](const Index& i) { s[i] += 0.25 * e[i] - 0.5 * t[i]; });
      });
}

TaskDeclaration find_edges()
{
  return task("find edges")
      .over_patches_and_groups()
      .reads(smooth.halo(1))
      .computes(edges)
      .body([](const TaskContext& at, auto data) {
        const auto s = data[smooth];
        const auto e = data[edges];
        const IndexBox all = seen_cells(at.layout.grid());
        for_each(at.patch.cells, [&](const Index& i) {
          e[i] = 0;
          for_each(intersection(grown(IndexBox{i, {i[0] + 1, i[1] + 1, 1}}, 1, 2), all),
                   [&](const Index& j) { e[i] += s[i] - s[j]; });
        });
      });
}

TaskDeclaration average_again()
{
  return task("average again")
      .over_patches_and_groups()
      .reads(smooth.halo(1))
      .computes(smoother)
      .reduces(total)
      .body([](const TaskContext& at, auto data) {
        const auto s = data[smooth];
        const auto now = data[smoother];
        double& sum = data[total];
        const IndexBox all = seen_cells(at.layout.grid());
        for_each(at.patch.cells, [&](const Index& i) {
          now[i] = 0;
          for_each(intersection(grown(IndexBox{i, {i[0] + 1, i[1] + 1, 1}}, 1, 2), all),
                   [&](const Index& j) { now[i] += s[j] / 9; });
          sum += now[i];
        });
      });
}

TaskDeclaration wander()
{
  return task("wander")
      .over_patches_and_groups()
      .reads(smooth, total, trace, old_trace, place.previous(), warmth.previous())
      .computes(place, warmth)
      .body([](const TaskContext& at, auto data) {
        const auto s = data[smooth];
        const double sum = data[total];
        const auto old = data[place.previous()];
        const auto was = data[warmth.previous()];
        const auto now = data[place];
        const auto is = data[warmth];
        const Grid& grid = at.layout.grid();
        for (std::size_t p = 0; p < old.size(); ++p) {
          const double w = s[{static_cast<int>(old[p][0]), static_cast<int>(old[p][1]), 0}];
          is[p] = 0.5 * was[p] + w / (1 + std::abs(sum)) + data[trace] - data[old_trace];
          now[p] = {old[p][0] + 0.9 * std::sin(37 * w), old[p][1] + 0.9 * std::cos(91 * w)};
          for (std::size_t k = 0; k < 2; ++k) {
            if (!grid.periodic[k]) now[p][k] = std::clamp(now[p][k], 0.01, grid.n_cells[k] - 0.01);
          }
        }
      });
}

TaskDeclaration recall()
{
  return task("recall")
      .over_ranks()
      .reads(trace.previous())
      .computes(old_trace)
      .body([](const TaskContext&, auto data) { data[old_trace] = data[trace.previous()]; });
}

TaskDeclaration keep_trace()
{
  return task("keep trace")
      .over_ranks()
      .reads(old_trace, total)
      .computes(trace)
      .body([](const TaskContext&, auto data) { data[trace] = data[old_trace] / 3 + 1 / (3 + std::abs(data[total])); });
}

/// Particles that wander, warm the nodes and are warmed by their neighbourhood: every kind of message there is. The
/// numbers are such that another order of sums shows.
std::vector<TaskDeclaration> wandering()
{
  return {warm(),   chill(),      average(), find_edges(), average_again(),
          recall(), keep_trace(), sharpen(), wander(),     migration(place, total)};
}

/// Patches dealt out to ranks in turn, in strides.
std::vector<int> dealt_out(int n_patches, int stride, int n_ranks)
{
  std::vector<int> ranks;
  ranks.reserve(static_cast<std::size_t>(n_patches));
  for (int p = 0; p < n_patches; ++p) ranks.push_back((p * stride) % n_ranks);
  return ranks;
}

struct World {
  World(const Communicator& communicator_, const std::vector<int>& ranks, int n_threads, bool periodic = false)
      : communicator(communicator_),
        layout(dealt(ranks, periodic)),
        graph(wandering(), layout, {"only"}, {{&place, &warmth, &smooth, &trace, &total}, {}}),
        warehouse(std::vector<const TaskGraph*>{&graph}, communicator.rank()),
        bound(graph, warehouse, communicator),
        schedule(bound, n_threads),
        executor(n_threads, test::on_shared_cores())
  {
  }

  static const Index& n_patches()
  {
    static const Index n{4, 3, 1};
    return n;
  }

  PatchLayout dealt(const std::vector<int>& ranks, bool periodic) const
  {
    Grid grid{2, {0, 0, 0}, 1, {16, 12, 1}};
    grid.periodic = {periodic, periodic, false};
    PatchLayout patches(grid, n_patches());
    patches.give_to_ranks(ranks, communicator.size());
    return patches;
  }

  void fill()
  {
    warehouse.global_state(trace) = 0.7;
    for (const Patch& patch : layout) {
      if (!warehouse.is_local(patch)) continue;
      warehouse.set_n_particles(patch.id, 0, static_cast<std::size_t>(patch.cells.size()));
      std::size_t p = 0;
      for_each(patch.cells, [&](const Index& i) {
        warehouse.state(place, patch.id, 0)[p] = {i[0] + 0.3, i[1] + 0.6};
        warehouse.state(warmth, patch.id, 0)[p++] = 1.0 / (1 + i[0] + 7 * i[1]);
      });
    }
  }

  void run(int n_steps)
  {
    for (int n = 0; n < n_steps; ++n) {
      executor.run(schedule, {n, 0, 1, 1});
      warehouse.advance();
    }
  }

  /// The last total and that of all steps, every rank's trace being the same, and all other state: by patch.
  std::vector<double> values()
  {
    std::vector<double> all{warehouse.result(total), warehouse.total(total), warehouse.global_state(trace)};
    for (const double theirs : communicator.gather_value(all.back())) CHECK(theirs == all.back());
    for (const Patch& patch : layout) {
      std::vector<double> own;
      if (warehouse.is_local(patch)) {
        for (const Point& x : warehouse.state(place, patch.id, 0)) own.insert(own.end(), x.begin(), x.end());
        const auto w = warehouse.state(warmth, patch.id, 0);
        own.insert(own.end(), w.begin(), w.end());
        const auto s = warehouse.grid_state(smooth, patch.id, 0);
        for_each(patch.cells, [&](const Index& i) { own.push_back(s[i]); });
      }
      for (const auto& bytes : communicator.gather(std::as_bytes(std::span(own)))) {
        const auto* first = reinterpret_cast<const double*>(bytes.data());
        all.insert(all.end(), first, first + bytes.size() / sizeof(double));
      }
    }
    return all;
  }

  Communicator communicator;
  PatchLayout layout;
  TaskGraph graph;
  Warehouse warehouse;
  BoundGraph bound;
  Schedule schedule;
  Executor executor;
};

std::vector<int> along_curve(int n_ranks)
{
  return deal_patches(curve_order(World::n_patches()), std::vector<double>(12, 1.0), n_ranks);
}

std::vector<double> alone(int n_steps, bool periodic = false)
{
  World world({}, std::vector<int>(12, 0), 1, periodic);
  world.fill();
  world.run(n_steps);
  return world.values();
}

}  // namespace

TEST_CASE("any ranks and threads give the same bits", "[ranks]")
{
  const Communicator all = Communicator::world();
  const int n_threads = GENERATE(1, 2, 3);
  World world(all, along_curve(all.size()), n_threads);
  world.fill();

  world.run(40);

  CHECK(world.values() == alone(40));
}

TEST_CASE("a world without ends has the same bits on any ranks and threads", "[ranks][periodic]")
{
  const Communicator all = Communicator::world();
  const int n_threads = GENERATE(1, 3);
  World world(all, along_curve(all.size()), n_threads, true);
  world.fill();

  world.run(40);

  CHECK(world.values() == alone(40, true));
  CHECK(world.values() != alone(40));
}

TEST_CASE("patches dealt in turn, with neighbours on every rank, give the same bits", "[ranks]")
{
  const Communicator all = Communicator::world();
  const std::vector<int> ranks = dealt_out(12, 1, all.size());
  World world(all, ranks, 2);
  world.fill();

  world.run(40);

  CHECK(world.values() == alone(40));
}

TEST_CASE("a rank without patches takes part", "[ranks]")
{
  const Communicator all = Communicator::world();
  World world(all, std::vector<int>(12, all.size() - 1), 1);
  world.fill();

  world.run(10);

  CHECK(world.values() == alone(10));
}

TEST_CASE("a task that throws on one rank stops the others, which hear why", "[ranks]")
{
  const Communicator all = Communicator::world();
  const int thrower = all.size() - 1;
  PatchLayout layout({2, {0, 0, 0}, 1, {16, 12, 1}}, World::n_patches());
  layout.give_to_ranks(along_curve(all.size()), all.size());
  auto make = task("make").over_patches_and_groups().computes(smooth).body([&](const TaskContext& at, auto) {
    if (at.patch.rank == thrower && at.step.index == 3) throw std::runtime_error("no luck");
  });
  auto use = task("use")
                 .over_patches_and_groups()
                 .reads(smooth.halo(1))
                 .computes(smoother)
                 .reduces(total)
                 .body([](const TaskContext&, auto) {});
  const TaskGraph graph({make, use}, layout, {"only"}, {{}, {&total, &smoother}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph}, all.rank());
  BoundGraph bound(graph, warehouse, all);
  Schedule schedule(bound, 2);
  Executor executor(2, test::on_shared_cores());

  std::string heard;
  try {
    for (long n = 0; n < 10; ++n) executor.run(schedule, {n, 0, 1, 1});
  } catch (const std::runtime_error& error) {
    heard = error.what();
  }

  CHECK(heard.find("no luck") != std::string::npos);
  all.barrier();
}

}  // namespace tamp::runtime::test_ranks
