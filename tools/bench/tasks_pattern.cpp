#include "tools/bench/tasks_pattern.hpp"

#include <algorithm>
#include <cstddef>

namespace tamp::tools::bench
{

namespace
{

/// Points from `first` to `last` in steps of `stride`, as far as there are any.
std::vector<int> clipped(int first, int last, int stride, int width)
{
  std::vector<int> points;
  for (int point = first; point <= last; point += stride) {
    if (point >= 0 && point < width) points.push_back(point);
  }
  return points;
}

/// A row that reads nothing, and then always the same.
std::vector<PatternRow> repeated(const PatternRow& row, int n_steps)
{
  std::vector<PatternRow> rows(static_cast<std::size_t>(n_steps), row);
  rows.front().assign(row.size(), {});
  return rows;
}

}  // namespace

int TaskPattern::n_tasks() const
{
  std::size_t n = 0;
  for (const PatternRow& row : rows) n += row.size();
  return static_cast<int>(n);
}

TaskPattern stencil_pattern(int width, int n_steps)
{
  PatternRow row;
  row.reserve(static_cast<std::size_t>(width));
  for (int point = 0; point < width; ++point) row.push_back(clipped(point - 1, point + 1, 1, width));
  return {"stencil 3", repeated(row, n_steps), PatternShape{{width, 1, 1}, false}};
}

TaskPattern nearest_27_pattern(int edge, int n_steps)
{
  PatternRow row;
  for (int point = 0; point < edge * edge * edge; ++point) {
    std::vector<int>& read = row.emplace_back();
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
  return {"nearest 27", repeated(row, n_steps), PatternShape{{edge, edge, edge}, true}};
}

TaskPattern fft_pattern(int width, int n_steps)
{
  TaskPattern pattern{"fft", {PatternRow(static_cast<std::size_t>(width))}};
  int apart = 1;
  for (int step = 1; step < n_steps; ++step) {
    PatternRow& row = pattern.rows.emplace_back();
    for (int point = 0; point < width; ++point) row.push_back(clipped(point - apart, point + apart, apart, width));
    apart = 2 * apart < width ? 2 * apart : 1;
  }
  return pattern;
}

TaskPattern tree_pattern(int width, int n_steps)
{
  TaskPattern pattern{"tree", {PatternRow(1)}};
  for (int step = 1; step < n_steps; ++step) {
    const int before = static_cast<int>(pattern.rows.back().size());
    const int n_children = before < width ? 2 : 1;
    PatternRow& row = pattern.rows.emplace_back();
    for (int point = 0; point < before * n_children; ++point) row.push_back({point / n_children});
  }
  return pattern;
}

}  // namespace tamp::tools::bench
