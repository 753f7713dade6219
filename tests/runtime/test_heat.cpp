#include "tests/runtime/heat.hpp"

#include <catch2/catch.hpp>

namespace tamp::test::test_heat
{

TEST_CASE("heat diffuses at second order through any cut into patches", "[runtime]")
{
  const double end = 0.02;
  const auto error = [&](int n_cells, Index n_patches) {
    Heat heat(n_cells, n_patches, 2);
    const long n_steps = n_cells * n_cells / 8;
    heat.run(n_steps, end / static_cast<double>(n_steps));
    return heat.error(end);
  };

  const double coarse = error(16, {2, 2, 1});
  const double fine = error(32, {4, 1, 1});

  CHECK(coarse < 5e-3);
  CHECK(std::log2(coarse / fine) > 1.9);
  CHECK(std::log2(coarse / fine) < 2.1);
}

TEST_CASE("heat is bitwise the same for any number of patches and threads", "[runtime]")
{
  const auto run = [](Index n_patches, int n_threads) {
    Heat heat(24, n_patches, n_threads);
    heat.run(50, 1e-4);
    return heat.values();
  };

  const std::vector<double> alone = run({1, 1, 1}, 1);

  CHECK(run({4, 3, 1}, 1) == alone);
  CHECK(run({4, 3, 1}, 2) == alone);
  CHECK(run({2, 6, 1}, 3) == alone);
}

TEST_CASE("a reduction has the same bits for any number of threads", "[runtime]")
{
  const auto run = [](int n_threads) {
    Heat heat(24, {4, 3, 1}, n_threads);
    heat.run(20, 1e-4);
    return heat.engine.warehouse().result(Heat::total);
  };

  const double alone = run(1);

  CHECK(run(2) == alone);
  CHECK(run(4) == alone);
  CHECK(std::abs(alone) < 1e-12);
}

TEST_CASE("an accumulated reduction is the sum over all steps since it was last taken", "[runtime]")
{
  Heat heat(24, {4, 3, 1}, 2);
  double sum = 0;
  const auto run = [&](int n_steps) {
    for (int n = 0; n < n_steps; ++n) {
      heat.run(1, 1e-4);
      sum += heat.engine.warehouse().result(Heat::total);
    }
  };

  run(5);
  CHECK(heat.engine.warehouse().total(Heat::total) == sum);
  CHECK(heat.engine.warehouse().take(Heat::total) == sum);
  CHECK(heat.engine.warehouse().total(Heat::total) == 0);
  sum = 0;
  run(3);
  CHECK(heat.engine.warehouse().total(Heat::total) == sum);
  CHECK(sum != 0);
}

TEST_CASE("a task reads what an accumulated reduction came to before the step", "[runtime]")
{
  const ReductionLabel<double, "cells"> cells;
  const GlobalLabel<double, "cells before"> before;
  const TaskDeclaration count = task("count").over_patches().reduces(cells).body(
      [&](const TaskContext& at, auto data) { data[cells] = static_cast<double>(at.patch.cells.size()); });
  const TaskDeclaration look =
      task("look")
          .over_ranks()
          .reads(cells.previous(), cells)
          .computes(before)
          .body([&](const TaskContext&, auto data) { data[before] = data[cells.previous()] + data[cells] / 1000; });
  const Grid grid{2, {0, 0, 0}, 1, {4, 4, 1}};
  Executor executor(1);
  Engine engine({grid, {2, 2, 1}}, {"all"}, {{{count, look}, {{&cells, &before}, {}}}}, executor);

  for (int n = 0; n < 3; ++n) engine.advance(1);

  CHECK(engine.warehouse().global_state(before) == 32.016);
  CHECK(engine.warehouse().total(cells) == 48);
}

}  // namespace tamp::test::test_heat
