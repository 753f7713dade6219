#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "tools/bench/tasks_pattern.hpp"

namespace test_tasks_pattern
{

using namespace tamp::tools::bench;

namespace
{

/// Whether two of `edge` places in a ring are the same or next to each other.
bool near(int a, int b, int edge)
{
  const int apart = std::abs(a - b);
  return apart <= 1 || apart == edge - 1;
}

}  // namespace

TEST_CASE("a point of the stencil reads itself and its neighbours, and the ends are clipped")
{
  const TaskPattern pattern = stencil_pattern(4, 10);

  CHECK(pattern.n_tasks() == 40);
  REQUIRE(pattern.rows.size() == 10);
  CHECK(pattern.rows[0] == PatternRow(4));
  CHECK(pattern.rows[1] == PatternRow{{0, 1}, {0, 1, 2}, {1, 2, 3}, {2, 3}});
  CHECK(pattern.rows[9] == pattern.rows[1]);
}

TEST_CASE("a point of the cube reads exactly the 27 points around it, across the faces too")
{
  const int edge = GENERATE(3, 4, 5);

  const TaskPattern pattern = nearest_27_pattern(edge, 10);

  const int n = edge * edge * edge;
  REQUIRE(pattern.rows.back().size() == static_cast<std::size_t>(n));
  for (int a = 0; a < n; ++a) {
    std::vector<int> expected;
    for (int b = 0; b < n; ++b) {
      if (near(a % edge, b % edge, edge) && near(a / edge % edge, b / edge % edge, edge) &&
          near(a / (edge * edge), b / (edge * edge), edge)) {
        expected.push_back(b);
      }
    }
    CHECK(expected.size() == 27);
    CHECK(pattern.rows.back()[static_cast<std::size_t>(a)] == expected);
  }
}

TEST_CASE(
    "a point of the fft reads itself and what is a butterfly apart, twice as far in each step and then as near again")
{
  const TaskPattern pattern = fft_pattern(8, 5);

  REQUIRE(pattern.rows.size() == 5);
  CHECK(pattern.rows[0] == PatternRow(8));
  CHECK(pattern.rows[1] ==
        PatternRow{{0, 1}, {0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 5}, {4, 5, 6}, {5, 6, 7}, {6, 7}});
  CHECK(pattern.rows[2] == PatternRow{{0, 2}, {1, 3}, {0, 2, 4}, {1, 3, 5}, {2, 4, 6}, {3, 5, 7}, {4, 6}, {5, 7}});
  CHECK(pattern.rows[3] == PatternRow{{0, 4}, {1, 5}, {2, 6}, {3, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}});
  CHECK(pattern.rows[4] == pattern.rows[1]);
}

TEST_CASE("a tree doubles until it is as wide as it may be, and then keeps its points")
{
  const TaskPattern pattern = tree_pattern(4, 4);

  CHECK(pattern.n_tasks() == 1 + 2 + 4 + 4);
  CHECK(pattern.rows == std::vector<PatternRow>{{{}}, {{0}, {0}}, {{0}, {0}, {1}, {1}}, {{0}, {1}, {2}, {3}}});
}

}  // namespace test_tasks_pattern
