#include "runtime/grid/curve_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <numeric>

namespace tamp::runtime::test_curve_order
{

namespace
{

/// How many steps along the axes lie between two places of a box.
int distance(int a, int b, const Index& n)
{
  const auto index = [&](int place) { return Index{place % n[0], place / n[0] % n[1], place / (n[0] * n[1])}; };
  const Index i = index(a), j = index(b);
  return std::abs(i[0] - j[0]) + std::abs(i[1] - j[1]) + std::abs(i[2] - j[2]);
}

}  // namespace

TEST_CASE("the curve passes every place once", "[grid]")
{
  const Index n = GENERATE(Index{1, 1, 1}, Index{7, 1, 1}, Index{5, 3, 1}, Index{3, 4, 5});
  std::vector<int> order = curve_order(n);

  std::sort(order.begin(), order.end());

  std::vector<int> all(static_cast<std::size_t>(n[0] * n[1] * n[2]));
  std::iota(all.begin(), all.end(), 0);
  CHECK(order == all);
}

TEST_CASE("through a cube whose side is a power of two every step of the curve is to a neighbour", "[grid]")
{
  const Index n = GENERATE(Index{8, 8, 8}, Index{4, 4, 4});
  const std::vector<int> order = curve_order(n);

  int longest = 0;
  for (std::size_t k = 1; k < order.size(); ++k) longest = std::max(longest, distance(order[k - 1], order[k], n));

  CHECK(longest == 1);
}

}  // namespace tamp::runtime::test_curve_order
