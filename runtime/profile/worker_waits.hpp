#pragma once

#include <cstdint>
#include <vector>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"

namespace tamp::runtime
{

/// Why the workers of a rank stood still: for which task they waited before they went on with one, or before the step
/// ended. A wait counts for the last predecessor of what a worker ran next, as long as that was not done.
class WorkerWaits
{
 public:
  /// Tasks are known by their rows in the profile, of which there may be more with every call.
  void make_room(std::size_t n_rows);
  void add_step(const BoundGraph& graph, const std::vector<InstanceRecord>& records,
                const std::vector<std::size_t>& row_of_instance);
  /// Ticks by row of what was to be run next and, fastest, of what it waited for; the rows end with one for the end of
  /// the step.
  const std::vector<std::uint64_t>& ticks() const { return ticks_; }
  std::size_t n_rows() const { return n_rows_; }

 private:
  void add(std::size_t row, std::size_t cause, std::uint64_t ticks) { ticks_[row * n_rows_ + cause] += ticks; }

  std::size_t n_rows_ = 0;
  std::vector<std::uint64_t> ticks_;
  /// Room for the instances of a step, by worker and start.
  std::vector<int> order_;
};

}  // namespace tamp::runtime
