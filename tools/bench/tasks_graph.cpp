#include "tools/bench/tasks_graph.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tamp::tools::bench
{

StampedTasks::StampedTasks(const TaskPattern& pattern)
    : rows_{0},
      shape_(pattern.shape),
      first_inputs_{0},
      outputs_(static_cast<std::size_t>(pattern.n_tasks())),
      base_(outputs_.size())
{
  int row_before = 0;
  for (const PatternRow& row : pattern.rows) {
    for (const std::vector<int>& read : row) {
      for (const int point : read) inputs_.push_back(row_before + point);
      first_inputs_.push_back(static_cast<int>(inputs_.size()));
    }
    row_before = rows_.back();
    rows_.push_back(row_before + static_cast<int>(row.size()));
  }
  for (std::size_t task = 0; task < outputs_.size(); ++task) outputs_[task].stamp = base_ + task;
}

int StampedTasks::step_of(int task) const
{
  return static_cast<int>(std::ranges::upper_bound(rows_, task) - rows_.begin()) - 1;
}

std::vector<std::vector<int>> StampedTasks::readers() const
{
  std::vector<std::vector<int>> all(outputs_.size());
  for (int task = 0; task < size(); ++task) {
    for (const int input : inputs(task)) all[static_cast<std::size_t>(input)].push_back(task);
  }
  return all;
}

std::string StampedTasks::describe(int task) const
{
  const int step = step_of(task);
  return fmt::format("step {}, point {}", step, task - row(step));
}

std::string StampedTasks::fault() const
{
  const int wrong = wrong_task_;
  if (wrong >= 0) return "the task of " + describe(wrong) + " ran before what it reads, or twice";
  for (int task = 0; task < size(); ++task) {
    if (outputs_[static_cast<std::size_t>(task)].stamp != base_ + static_cast<std::uint64_t>(task)) {
      return "the task of " + describe(task) + " was left out";
    }
  }
  return {};
}

}  // namespace tamp::tools::bench
