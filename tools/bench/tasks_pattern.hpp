#pragma once

#include <array>
#include <string>
#include <vector>

namespace tamp::tools::bench
{

/// The points in space, along x first: each reads what touches it, across the ends too where they are one place.
struct PatternShape {
  std::array<int, 3> n_points{1, 1, 1};
  bool is_periodic = false;
};

/// Which tasks a task waits for, after Task Bench (Slaughter et al., SC 2020): a graph has `n_steps` rows of `width`
/// points, and a task of one row reads what some tasks of the row before have made. The first row reads nothing.
struct TaskPattern {
  std::string name;
  int width = 0;
  int n_steps = 0;
  /// For each point, in rising order, the points of the row before that it reads.
  std::vector<std::vector<int>> dependencies;
  PatternShape shape{};

  int n_tasks() const { return width * n_steps; }
};

/// Each point reads itself and its two neighbours; the two ends of the row have but one.
TaskPattern stencil_pattern(int width, int n_steps);

/// Each point of a cube of `edge`^3, periodic, reads itself and its 26 neighbours. `edge` is 3 or more.
TaskPattern nearest_27_pattern(int edge, int n_steps);

}  // namespace tamp::tools::bench
