#include "tools/bench/tasks_graph.hpp"

#include <fmt/format.h>

namespace tamp::tools::bench
{

StampedTasks::StampedTasks(const TaskPattern& pattern)
    : width_(pattern.width),
      n_steps_(pattern.n_steps),
      shape_(pattern.shape),
      first_inputs_{0},
      outputs_(static_cast<std::size_t>(pattern.n_tasks())),
      base_(outputs_.size())
{
  for (int task = 0; task < size(); ++task) {
    outputs_[static_cast<std::size_t>(task)].stamp = base_ + static_cast<std::uint64_t>(task);
    const int row_before = (task / width_ - 1) * width_;
    if (row_before >= 0) {
      for (const int point : pattern.dependencies[static_cast<std::size_t>(task % width_)]) {
        inputs_.push_back(row_before + point);
      }
    }
    first_inputs_.push_back(static_cast<int>(inputs_.size()));
  }
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
  return fmt::format("step {}, point {}", task / width_, task % width_);
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
