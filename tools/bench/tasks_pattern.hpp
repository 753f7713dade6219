#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tamp::tools::bench
{

/// The points in space, along x first: each reads what touches it, across the ends too where they are one place.
struct PatternShape {
  std::array<int, 3> n_points{1, 1, 1};
  bool is_periodic = false;
};

/// For each point of a row, in rising order, the points of the row before that it reads.
using PatternRow = std::vector<std::vector<int>>;

/// Which tasks a task waits for, after Task Bench (Slaughter et al., SC 2020): a graph has rows of points, and a task
/// of one row reads what some tasks of the row before have made. The first row reads nothing.
struct TaskPattern {
  std::string name;
  std::vector<PatternRow> rows;
  /// Where all rows read their neighbours in space.
  std::optional<PatternShape> shape{};

  int n_tasks() const;
};

/// Each point reads itself and its two neighbours; the two ends of the row have but one.
TaskPattern stencil_pattern(int width, int n_steps);

/// Each point of a cube of `edge`^3, periodic, reads itself and its 26 neighbours. `edge` is 3 or more.
TaskPattern nearest_27_pattern(int edge, int n_steps);

/// Each point reads itself and those as far away on both sides as a butterfly of the step is wide: 1, 2, 4 and so on
/// below `width`, then again from 1.
TaskPattern fft_pattern(int width, int n_steps);

/// A tree: one point, then two for each of the row before until there are `width`, a power of two; then each reads
/// itself.
TaskPattern tree_pattern(int width, int n_steps);

}  // namespace tamp::tools::bench
