#include "runtime/profile/worker_waits.hpp"

#include <catch2/catch.hpp>

#include "tests/runtime/heat.hpp"

namespace tamp::runtime::test_worker_waits
{

namespace
{

const CellLabel<double, "early"> early;
const CellLabel<double, "late"> late;

/// Two tasks, the second of which waits for the first, on one patch.
struct Pair {
  PatchLayout layout{{2, {0, 0, 0}, 1, {3, 3, 1}}, {1, 1, 1}};
  TaskGraph graph{
      {task("make").over_patches_and_groups().computes(early).body([](const TaskContext&, auto) {}),
       task("use").over_patches_and_groups().reads(early).computes(late).body([](const TaskContext&, auto) {})},
      layout,
      {"only"},
      {{}, {&late}}};
  Warehouse warehouse{std::vector<const TaskGraph*>{&graph}};
  BoundGraph bound{graph, warehouse};
};

constexpr std::size_t make = 0, use = 1, end_of_step = 2;

std::uint64_t ticks(const WorkerWaits& waits, std::size_t row, std::size_t cause)
{
  return waits.ticks()[row * waits.n_rows() + cause];
}

}  // namespace

TEST_CASE("a worker waits for the predecessor of what it runs next, and for the end of the step", "[profile]")
{
  Pair pair;
  WorkerWaits waits;
  waits.make_room(2);

  waits.add_step(pair.bound, {{100, 110, 0}, {112, 130, 1}}, {make, use});

  // From the step's start to the end of the first task; two more ticks it was ready.
  CHECK(ticks(waits, use, make) == 10);
  CHECK(ticks(waits, end_of_step, use) == 20);
  CHECK(ticks(waits, make, use) == 0);
  CHECK(ticks(waits, end_of_step, make) == 0);
}

TEST_CASE("a worker that goes from task to task waits for none", "[profile]")
{
  Pair pair;
  WorkerWaits waits;
  waits.make_room(2);

  waits.add_step(pair.bound, {{100, 110, 0}, {115, 130, 0}}, {make, use});

  CHECK(waits.ticks() == std::vector<std::uint64_t>(6, 0));
}

TEST_CASE("waits keep their tasks when there are more of these", "[profile]")
{
  Pair pair;
  WorkerWaits waits;
  waits.make_room(2);
  waits.add_step(pair.bound, {{100, 110, 0}, {112, 130, 1}}, {make, use});

  waits.make_room(4);

  CHECK(ticks(waits, use, make) == 10);
  CHECK(ticks(waits, 4, use) == 20);
}

}  // namespace tamp::runtime::test_worker_waits
