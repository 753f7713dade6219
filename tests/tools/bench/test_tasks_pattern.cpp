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
  CHECK(pattern.dependencies == std::vector<std::vector<int>>{{0, 1}, {0, 1, 2}, {1, 2, 3}, {2, 3}});
}

TEST_CASE("a point of the cube reads exactly the 27 points around it, across the faces too")
{
  const int edge = GENERATE(3, 4, 5);

  const TaskPattern pattern = nearest_27_pattern(edge, 10);

  REQUIRE(pattern.width == edge * edge * edge);
  for (int a = 0; a < pattern.width; ++a) {
    std::vector<int> expected;
    for (int b = 0; b < pattern.width; ++b) {
      if (near(a % edge, b % edge, edge) && near(a / edge % edge, b / edge % edge, edge) &&
          near(a / (edge * edge), b / (edge * edge), edge)) {
        expected.push_back(b);
      }
    }
    CHECK(expected.size() == 27);
    CHECK(pattern.dependencies[static_cast<std::size_t>(a)] == expected);
  }
}

}  // namespace test_tasks_pattern
