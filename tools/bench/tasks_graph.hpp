#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/bench/tasks_kernel.hpp"
#include "tools/bench/tasks_pattern.hpp"

namespace tamp::tools::bench
{

/// The tasks of a pattern, to be run again and again by some scheduler; they are numbered row by row. A task checks the
/// stamp of everything that it reads, runs the kernel, and leaves its own stamp: one number for (run, step, point).
class StampedTasks
{
 public:
  explicit StampedTasks(const TaskPattern& pattern);

  int n_steps() const { return static_cast<int>(rows_.size()) - 1; }
  /// The first task of a step; of the one after the last, the number of all.
  int row(int step) const { return rows_[static_cast<std::size_t>(step)]; }
  int step_of(int task) const;
  const std::optional<PatternShape>& shape() const { return shape_; }
  int size() const { return static_cast<int>(outputs_.size()); }
  /// The tasks that a task reads.
  std::span<const int> inputs(int task) const
  {
    const auto first = static_cast<std::size_t>(first_inputs_[static_cast<std::size_t>(task)]);
    return {inputs_.data() + first,
            static_cast<std::size_t>(first_inputs_[static_cast<std::size_t>(task) + 1]) - first};
  }
  /// The tasks that read a task, for schedulers that push.
  std::vector<std::vector<int>> readers() const;
  /// "step 3, point 7"
  std::string describe(int task) const;

  /// Work of each task; 0 for an empty body.
  int kernel_iterations = 0;

  /// To be called before each run of all tasks.
  void begin_run() { base_ += outputs_.size(); }
  /// Called by a scheduler for each task once a run. A breach of order is kept for `fault`.
  void run(int task) noexcept
  {
    Output& output = outputs_[static_cast<std::size_t>(task)];
    const std::uint64_t stamp = base_ + static_cast<std::uint64_t>(task);
    std::uint64_t wrong = output.stamp ^ (stamp - outputs_.size());
    for (const int input : inputs(task)) {
      wrong |= outputs_[static_cast<std::size_t>(input)].stamp ^ (base_ + static_cast<std::uint64_t>(input));
    }
    if (wrong != 0) wrong_task_ = task;
    if (kernel_iterations > 0) output.value = multiply_add_kernel(kernel_iterations);
    output.stamp = stamp;
  }
  /// The first fault of any run so far: a task that ran before what it reads, twice or not at all. Empty if nothing.
  std::string fault() const;

 private:
  /// On a cache line of its own, as what a task makes would be.
  struct alignas(64) Output {
    std::uint64_t stamp = 0;
    double value = 0;
  };

  std::vector<int> rows_;
  std::optional<PatternShape> shape_;
  /// Inputs of task t stand in inputs_ from first_inputs_[t] up to first_inputs_[t + 1].
  std::vector<int> first_inputs_;
  std::vector<int> inputs_;
  std::vector<Output> outputs_;
  std::uint64_t base_;
  std::atomic<int> wrong_task_{-1};
};

}  // namespace tamp::tools::bench
