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

}  // namespace tamp::test::test_heat
