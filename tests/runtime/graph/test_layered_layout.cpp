#include "runtime/graph/layered_layout.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace tamp::runtime::test_layered_layout
{

namespace
{

using Edges = std::vector<std::pair<int, int>>;

constexpr double height = 30;

/// Edges from lower to higher numbers, each pair at most once.
Edges some_edges(int n_boxes, unsigned seed)
{
  std::mt19937 random(seed);
  Edges edges;
  for (int to = 1; to < n_boxes; ++to) {
    for (int from = 0; from < to; ++from) {
      if (random() % 6 == 0) edges.emplace_back(from, to);
    }
  }
  return edges;
}

std::vector<double> some_widths(int n_boxes)
{
  std::vector<double> widths;
  widths.reserve(static_cast<std::size_t>(n_boxes));
  for (int i = 0; i < n_boxes; ++i) widths.push_back(40 + 37 * (i % 5));
  return widths;
}

/// Where a route is at a height, if it runs straight down there.
bool passes(const Route& route, const LaidBox& box, double width)
{
  for (std::size_t k = 2; k < route.size(); k += 2) {
    const bool in_row = route[k].y > box.top && route[k - 1].y < box.top + height;
    if (in_row && std::abs(route[k].x - box.x) < width / 2) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a box stands below all that lead to it, right below the last", "[graph]")
{
  const Edges edges{{0, 1}, {1, 2}, {0, 3}, {2, 4}, {3, 4}};
  const std::vector<double> widths(5, 50);

  const LayeredLayout layout = lay_out(widths, height, edges);

  std::vector<int> rows;
  for (const LaidBox& box : layout.boxes) rows.push_back(box.row);
  CHECK(rows == std::vector<int>{0, 1, 2, 1, 3});
}

TEST_CASE("boxes do not overlap, lie in the drawing, and lines go around them", "[graph]")
{
  for (const unsigned seed : {1U, 2U, 3U}) {
    const int n_boxes = 30;
    const Edges edges = some_edges(n_boxes, seed);
    const std::vector<double> widths = some_widths(n_boxes);

    const LayeredLayout layout = lay_out(widths, height, edges);

    for (std::size_t a = 0; a < widths.size(); ++a) {
      const LaidBox& box = layout.boxes[a];
      CHECK(box.x - widths[a] / 2 >= 0);
      CHECK(box.x + widths[a] / 2 <= layout.width);
      CHECK(box.top + height <= layout.height);
      for (std::size_t b = 0; b < a; ++b) {
        if (layout.boxes[b].row != box.row) continue;
        CHECK(std::abs(layout.boxes[b].x - box.x) > (widths[a] + widths[b]) / 2);
      }
      for (const Route& route : layout.routes) CHECK(!passes(route, box, widths[a]));
    }
  }
}

TEST_CASE("a route leads from the lower end of its first box to the upper end of its last", "[graph]")
{
  const Edges edges = some_edges(20, 5);
  const std::vector<double> widths = some_widths(20);

  const LayeredLayout layout = lay_out(widths, height, edges);

  REQUIRE(layout.routes.size() == edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto from = static_cast<std::size_t>(edges[i].first), to = static_cast<std::size_t>(edges[i].second);
    const Route& route = layout.routes[i];
    CHECK(route.front().x == layout.boxes[from].x);
    CHECK(route.front().y == layout.boxes[from].top + height);
    CHECK(std::abs(route.back().x - layout.boxes[to].x) < widths[to] / 2);
    CHECK(route.back().y == layout.boxes[to].top);
    CHECK(route.size() == 2 * static_cast<std::size_t>(layout.boxes[to].row - layout.boxes[from].row));
    for (std::size_t k = 1; k < route.size(); ++k) CHECK(route[k].y > route[k - 1].y);
  }
}

TEST_CASE("two lines that need not cross do not", "[graph]")
{
  // 0 and 1 lead to 3 and 2: in the order of their numbers the lines would cross.
  const Edges edges{{0, 3}, {1, 2}};
  const std::vector<double> widths(4, 50);

  const LayeredLayout layout = lay_out(widths, height, edges);

  const auto& box = layout.boxes;
  CHECK((box[0].x < box[1].x) == (box[3].x < box[2].x));
}

}  // namespace tamp::runtime::test_layered_layout
