#include "tools/bench/tasks_pattern.hpp"

#include <algorithm>

namespace tamp::tools::bench
{

TaskPattern stencil_pattern(int width, int n_steps)
{
  TaskPattern pattern{"stencil 3", width, n_steps, {}, {{width, 1, 1}, false}};
  for (int point = 0; point < width; ++point) {
    std::vector<int>& read = pattern.dependencies.emplace_back();
    for (int other = std::max(0, point - 1); other <= std::min(width - 1, point + 1); ++other) read.push_back(other);
  }
  return pattern;
}

TaskPattern nearest_27_pattern(int edge, int n_steps)
{
  TaskPattern pattern{"nearest 27", edge * edge * edge, n_steps, {}, {{edge, edge, edge}, true}};
  for (int point = 0; point < pattern.width; ++point) {
    std::vector<int>& read = pattern.dependencies.emplace_back();
    const int x = point % edge, y = point / edge % edge, z = point / (edge * edge);
    for (int k = z + edge - 1; k <= z + edge + 1; ++k) {
      for (int j = y + edge - 1; j <= y + edge + 1; ++j) {
        for (int i = x + edge - 1; i <= x + edge + 1; ++i) {
          read.push_back((k % edge * edge + j % edge) * edge + i % edge);
        }
      }
    }
    std::sort(read.begin(), read.end());
  }
  return pattern;
}

}  // namespace tamp::tools::bench
