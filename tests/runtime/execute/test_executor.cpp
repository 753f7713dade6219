#include "runtime/execute/executor.hpp"

#include <oneapi/tbb/global_control.h>
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <numeric>
#include <random>
#include <set>
#include <thread>

#include "runtime/execute/on_workers.hpp"
#include "tests/runtime/execute/toy_work.hpp"
#include "tests/runtime/heat.hpp"
#include "tests/runtime/shared_cores.hpp"

namespace tamp::runtime::test_executor
{

namespace
{

const CellLabel<double, "first"> first;
const CellLabel<double, "second"> second;
const NodeLabel<double, "sum"> sum;

/// Tasks over a row of patches, ready to run.
struct Row {
  Row(std::vector<TaskDeclaration> tasks, const HostData& host, int n_patches, int n_threads)
      : layout({2, {0, 0, 0}, 1, {3 * n_patches, 3, 1}}, {n_patches, 1, 1}),
        graph(std::move(tasks), layout, {"only"}, host),
        warehouse(std::vector<const TaskGraph*>{&graph}),
        bound(graph, warehouse),
        schedule(bound, n_threads),
        executor(n_threads)
  {
  }

  PatchLayout layout;
  TaskGraph graph;
  Warehouse warehouse;
  BoundGraph bound;
  Schedule schedule;
  Executor executor;
};

}  // namespace

namespace
{

/// Whether `n` workers of an executor ever ran at the same time: each waits a while for the others.
bool all_work(Executor& executor, int n)
{
  std::atomic<int> n_here{0};
  std::atomic<bool> met{false};
  on_workers(executor, n, [&](int) {
    ++n_here;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (!met && std::chrono::steady_clock::now() < end) {
      if (n_here == n) met = true;
      std::this_thread::yield();
    }
  });
  return met;
}

std::size_t threads_of_program()
{
  return oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
}

}  // namespace

TEST_CASE("executors leave the program the threads that it has, and have their own", "[executor]")
{
  const std::size_t before = threads_of_program();
  {
    Executor one(2, test::on_shared_cores()), other(4, test::on_shared_cores());

    CHECK(all_work(one, 2));
    CHECK(all_work(other, 4));
    CHECK(threads_of_program() == before + 1 + 3);
  }
  CHECK(threads_of_program() == before);
}

TEST_CASE("an executor says so where the program allows it too few threads", "[executor]")
{
  const oneapi::tbb::global_control two(oneapi::tbb::global_control::max_allowed_parallelism, 2);

  CHECK_NOTHROW(Executor(2));
  CHECK_THROWS_WITH(Executor(3), "this program limits oneTBB to 2 threads; expected at least 3");
}

TEST_CASE("every instance runs exactly once a step, after those it waits for", "[executor]")
{
  std::atomic<int> n_first{0};
  std::atomic<int> n_early{0};
  auto make = task("make").over_patches_and_groups().computes(first).body([&](const TaskContext& at, auto data) {
    const auto f = data[first];
    for_each(at.patch.cells, [&](const Index& i) { f[i] = static_cast<double>(at.step.index); });
    ++n_first;
  });
  auto use = task("use")
                 .over_patches_and_groups()
                 .reads(first.halo(1))
                 .computes(second)
                 .body([&](const TaskContext& at, auto data) {
                   const auto f = data[first];
                   const auto s = data[second];
                   const IndexBox inside = intersection(f.box(), at.layout.grid().cells());
                   for_each(inside, [&](const Index& i) { n_early += f[i] != static_cast<double>(at.step.index); });
                   for_each(at.patch.cells, [&](const Index& i) { s[i] = f[i]; });
                 });
  const int n_threads = GENERATE(1, 2, 3, 5);
  Row row({make, use}, {{}, {&second}}, 7, n_threads);

  for (long n = 1; n <= 200; ++n) row.executor.run(row.schedule, {n, 0, 1, 1});

  CHECK(n_first == 200 * 7);
  CHECK(n_early == 0);
}

TEST_CASE("a shuffled executor runs every instance once, in legal orders that differ from step to step", "[executor]")
{
  std::vector<int> makers, order;
  auto make = task("make").over_patches_and_groups().computes(first).body([&](const TaskContext& at, auto) {
    makers.push_back(at.patch.id);
    order.push_back(at.patch.id);
  });
  int n_early = 0;
  auto use = task("use").over_patches_and_groups().reads(first).computes(second).body([&](const TaskContext& at, auto) {
    n_early += std::count(makers.begin(), makers.end(), at.patch.id) == 0;
    order.push_back(100 + at.patch.id);
  });
  Row row({make, use}, {{}, {&second}}, 7, 1);
  const auto executor = Executor::shuffled(3);

  std::set<std::vector<int>> orders;
  for (int n = 0; n < 20; ++n) {
    makers.clear();
    order.clear();
    executor->run(row.schedule, {});
    CHECK(std::set<int>(order.begin(), order.end()).size() == 14);
    orders.insert(order);
  }

  CHECK(n_early == 0);
  CHECK(orders.size() == 20);
}

TEST_CASE("both sides of a seam get the same sum, parts added in the order of patches", "[executor]")
{
  // 1e16 + 1 - 1e16 depends on the order: patch by patch from the left it is 0 in the middle of three.
  const std::vector<double> parts{1e16, 1, -1e16};
  auto give =
      task("give").over_patches_and_groups().accumulates(sum.halo(1)).body([&](const TaskContext& at, auto data) {
        const auto s = data[sum];
        for_each(s.box(), [&](const Index& i) { s[i] = parts[static_cast<std::size_t>(at.patch.id)]; });
      });
  const int n_threads = GENERATE(1, 2);
  Row row({give}, {{}, {&sum}}, 3, n_threads);

  row.executor.run(row.schedule, {});

  // Nodes 2, 3, 4 are reached by patches 0 and 1; nodes 5, 6, 7 by 1 and 2.
  const auto left = row.warehouse.grid_result(sum, 0, 0);
  const auto middle = row.warehouse.grid_result(sum, 1, 0);
  const auto right = row.warehouse.grid_result(sum, 2, 0);
  CHECK(left[{1, 0, 0}] == 1e16);
  CHECK(left[{3, 0, 0}] == 1e16 + 1);
  CHECK(middle[{3, 0, 0}] == left[{3, 0, 0}]);
  CHECK(middle[{6, 0, 0}] == 1 - 1e16);
  CHECK(right[{6, 0, 0}] == middle[{6, 0, 0}]);
}

TEST_CASE("parts are summed by the += of their own type", "[executor]")
{
  struct Most {
    int value;
    void operator+=(const Most& other) { value = std::max(value, other.value); }
  };
  struct NoSum {
    double value;
  };
  static_assert(Addable<Most> && !Addable<NoSum>);
  const NodeLabel<int, "count"> count;
  const NodeLabel<Most, "most"> most;
  auto give = task("give")
                  .over_patches_and_groups()
                  .accumulates(count.halo(1), most.halo(1))
                  .body([&](const TaskContext& at, auto data) {
                    const auto counts = data[count];
                    const auto mosts = data[most];
                    for_each(counts.box(), [&](const Index& i) {
                      counts[i] = 1;
                      mosts[i] = {10 + at.patch.id};
                    });
                  });
  Row row({give}, {{}, {&count, &most}}, 2, 1);

  row.executor.run(row.schedule, {});

  const auto counts = row.warehouse.grid_result(count, 0, 0);
  const auto mosts = row.warehouse.grid_result(most, 0, 0);
  CHECK(counts[{1, 0, 0}] == 1);
  CHECK(mosts[{1, 0, 0}].value == 10);
  CHECK(counts[{3, 0, 0}] == 2);
  CHECK(mosts[{3, 0, 0}].value == 11);
}

TEST_CASE("tasks that accumulate one label add to it in the order of declaration", "[executor]")
{
  // 1e16 + 1 - 1e16 depends on the order; each halo alone would leave out nodes.
  const auto give = [](const char* name, int halo, double part) {
    return task(name).over_patches_and_groups().accumulates(sum.halo(halo)).body([=](const TaskContext&, auto data) {
      const auto s = data[sum];
      for_each(s.box(), [&](const Index& i) { s[i] += part; });
    });
  };
  auto take =
      task("take").over_patches_and_groups().reads(sum.halo(1)).computes(first).body([](const TaskContext&, auto data) {
        const auto s = data[sum];
        const auto f = data[first];
        for_each(f.box(), [&](const Index& i) { f[i] = s[i]; });
      });
  const int n_threads = GENERATE(1, 2);
  Row row({give("large", 0, 1e16), give("small", 1, 1), take, give("back", 1, -1e16)}, {{}, {&sum, &first}}, 2,
          n_threads);

  row.executor.run(row.schedule, {});

  for (const int p : {0, 1}) {
    const auto sums = row.warehouse.grid_result(sum, p, 0), taken = row.warehouse.grid_result(first, p, 0);
    // A patch's own nodes get 1e16 + 1 - 1e16, which is 0; those beyond, where the first task does not reach, 1 - 1e16.
    CHECK(sums[{p == 0 ? 0 : 6, 0, 0}] == 0);
    CHECK(sums[{3, 0, 0}] == 0);
    CHECK(sums[{2, 0, 0}] == 1 - 1e16);
    CHECK(taken[{p == 0 ? 2 : 4, 0, 0}] == 1 - 1e16);
  }
}

TEST_CASE("a task that throws stops the step with its name and patch", "[executor]")
{
  auto fail = task("fail").over_patches_and_groups().computes(first).body([](const TaskContext& at, auto) {
    if (at.patch.id == 2) throw std::runtime_error("no luck");
  });
  const int n_threads = GENERATE(1, 2, 3);
  Row row({fail}, {{}, {&first}}, 5, n_threads);

  CHECK_THROWS_WITH(row.executor.run(row.schedule, {}), "task 'fail' on patch 2: no luck");
}

TEST_CASE("a task that finds no memory says so in words", "[executor]")
{
  auto fail = task("fail").over_patches_and_groups().computes(first).body(
      [](const TaskContext&, auto) { throw std::bad_alloc(); });
  Row row({fail}, {{}, {&first}}, 1, 1);

  CHECK_THROWS_WITH(row.executor.run(row.schedule, {}), "task 'fail' on patch 0: out of memory");
}

TEST_CASE("of short and long tasks in disorder, dealt out unevenly, each runs once a step and none early", "[executor]")
{
  const int n_threads = GENERATE(2, 3, 4);
  std::mt19937 random(5);
  test::ToyWork work;
  work.messages = false;
  constexpr int n = 200;
  std::vector<std::atomic<long>> n_run(n);
  std::atomic<int> n_early{0};
  for (int i = 0; i < n; ++i) {
    std::vector<int> predecessors;
    for (int k = 0; k < 3 && i > 0; ++k) {
      predecessors.push_back(std::max(0, i - 1 - static_cast<int>(random() % 20)));
    }
    const int home = random() % 4 == 0 ? static_cast<int>(random() % 4) : 0;
    const bool is_long = random() % 10 == 0;
    work.add(home, predecessors, [&, i, predecessors, is_long](const Step& step) {
      for (const int p : predecessors) n_early += n_run[static_cast<std::size_t>(p)] != step.index;
      if (is_long) std::this_thread::yield();
      ++n_run[static_cast<std::size_t>(i)];
    });
  }
  Executor executor(n_threads);
  Schedule schedule(work, n_threads);

  for (long step = 1; step <= 300; ++step) executor.run(schedule, {step, 0, 1, 1});

  CHECK(n_early == 0);
  CHECK(std::all_of(n_run.begin(), n_run.end(), [](const auto& count) { return count == 300; }));
}

TEST_CASE("an idle worker takes over what another has no time for", "[executor]")
{
  // Both belong to worker 0, and the first to run goes on until the second has begun.
  test::ToyWork work;
  work.messages = false;
  std::atomic<int> n_begun{0};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const auto body = [&](const Step&) {
    ++n_begun;
    while (n_begun < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  };
  work.add(0, {}, body);
  work.add(0, {}, body);
  Executor executor(2);
  Schedule schedule(work, 2);

  executor.run(schedule, {});

  CHECK(std::chrono::steady_clock::now() < deadline);
  CHECK(schedule.records()[0].worker != schedule.records()[1].worker);
}

TEST_CASE("an executor serves several schedules in turn", "[executor]")
{
  test::Heat heat(12, {2, 2, 1}, 2);
  std::atomic<int> n{0};
  auto count = task("count").over_patches_and_groups().computes(first).body([&](const TaskContext&, auto) { ++n; });
  Row row({count}, {{}, {&first}}, 3, 2);

  for (int k = 0; k < 50; ++k) {
    heat.executor.run(heat.engine.schedule(), {k, 0, 1e-4, 1e-4});
    heat.executor.run(row.schedule, {});
  }

  CHECK(n == 150);
}

}  // namespace tamp::runtime::test_executor
