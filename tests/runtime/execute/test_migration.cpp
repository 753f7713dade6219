#include "runtime/execute/migration.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"

namespace tamp::runtime::test_migration
{

namespace
{

using Point = std::array<double, 2>;

const ParticleLabel<Point, "place"> place;
const ParticleLabel<std::int64_t, "number"> number;

/// Four patches in a square of 8 x 8 cells; particles drift by (dx, dy) each step.
struct Drift {
  Drift(double dx, double dy, int n_threads)
      : layout({2, {0, 0, 0}, 1, {8, 8, 1}}, {2, 2, 1}),
        graph({drift(dx, dy), migration(place)}, layout, {"only"}, {{&place, &number}, {}}),
        warehouse(std::vector<const TaskGraph*>{&graph}),
        bound(graph, warehouse),
        schedule(bound, n_threads),
        executor(n_threads)
  {
    for (const Patch& patch : layout) {
      warehouse.set_n_particles(patch.id, 0, static_cast<std::size_t>(patch.cells.size()));
      std::size_t p = 0;
      for_each(patch.cells, [&](const Index& i) {
        warehouse.state(place, patch.id, 0)[p] = {i[0] + 0.5, i[1] + 0.5};
        warehouse.state(number, patch.id, 0)[p++] = i[0] + 8 * i[1];
      });
    }
  }

  static TaskDeclaration drift(double dx, double dy)
  {
    return task("drift")
        .over_patches_and_groups()
        .reads(place.previous())
        .computes(place)
        .body([dx, dy](const TaskContext&, auto data) {
          const auto old = data[place.previous()];
          const auto now = data[place];
          for (std::size_t p = 0; p < old.size(); ++p) now[p] = {old[p][0] + dx, old[p][1] + dy};
        });
  }

  void step()
  {
    executor.run(schedule, {});
    warehouse.advance();
  }

  std::vector<std::int64_t> numbers(int patch)
  {
    const auto all = warehouse.state(number, patch, 0);
    return {all.begin(), all.end()};
  }

  PatchLayout layout;
  TaskGraph graph;
  Warehouse warehouse;
  BoundGraph bound;
  Schedule schedule;
  Executor executor;
};

}  // namespace

TEST_CASE("particles follow their position from patch to patch, across corners too", "[migration]")
{
  Drift drift(1, 1, 2);

  drift.step();

  for (const Patch& patch : drift.layout) {
    const auto places = drift.warehouse.state(place, patch.id, 0);
    const auto numbers = drift.warehouse.state(number, patch.id, 0);
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Index cell{static_cast<int>(places[p][0]), static_cast<int>(places[p][1]), 0};
      CHECK(patch.cells.contains(cell));
      CHECK(numbers[p] == cell[0] - 1 + 8 * (cell[1] - 1));
    }
  }
  // The corner particle of patch 0 went to patch 3 at once.
  const auto corner = drift.numbers(3);
  CHECK(std::find(corner.begin(), corner.end(), 3 + 8 * 3) != corner.end());
}

TEST_CASE("particles that leave the grid are gone, and no others", "[migration]")
{
  Drift drift(1, 0, 1);

  drift.step();

  CHECK(drift.warehouse.n_particles(0) == 56);
  for (const Patch& patch : drift.layout) {
    for (const std::int64_t id : drift.numbers(patch.id)) CHECK(id % 8 != 7);
  }
}

TEST_CASE("the order of particles after migration does not depend on threads", "[migration]")
{
  const auto order = [](int n_threads) {
    Drift drift(0.7, 0.4, n_threads);
    for (int n = 0; n < 5; ++n) drift.step();
    std::vector<std::int64_t> all;
    for (const Patch& patch : drift.layout) {
      const auto own = drift.numbers(patch.id);
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  };

  CHECK(order(2) == order(1));
  CHECK(order(3) == order(1));
}

TEST_CASE("a particle that is not a number leaves the grid instead of being indexed", "[migration]")
{
  Drift drift(std::numeric_limits<double>::quiet_NaN(), 0, 1);

  drift.step();

  CHECK(drift.warehouse.n_particles(0) == 0);
}

}  // namespace tamp::runtime::test_migration
