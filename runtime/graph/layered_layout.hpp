#pragma once

#include <span>
#include <utility>
#include <vector>

namespace tamp::runtime
{

/// Where a box of a drawing stands: its centre along x, its upper end along y, which points down.
struct LaidBox {
  double x = 0;
  double top = 0;
  int row = 0;
};

struct Point {
  double x = 0;
  double y = 0;
};

/// From the lower end of one box to the upper end of another. Between two points a line may bend while it goes from a
/// row to the next, every second stretch, and is straight where it passes a row.
using Route = std::vector<Point>;

struct LayeredLayout {
  std::vector<LaidBox> boxes;
  /// The route of each edge, from the box of the lower number to that of the higher.
  std::vector<Route> routes;
  double width = 0;
  double height = 0;
};

/// Boxes of one height in rows, each below all that lead to it, with edges that go around them: the layout of Sugiyama,
/// Tagawa and Toda (1981). An edge leads from the lower number to the higher, and not from a box to itself. Long edges
/// of one box share their way up to where they part.
LayeredLayout lay_out(std::span<const double> widths, double height, std::span<const std::pair<int, int>> edges);

}  // namespace tamp::runtime
