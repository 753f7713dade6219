#pragma once

#include <random>
#include <vector>

#include "runtime/execute/scheduler/schedule_state.hpp"

namespace tamp::runtime
{

/// The instances of a step that may run now, of which one is drawn at random, whatever its place in the lists.
class ReadyPool
{
 public:
  /// Makes the pool of a step that has begun. Messages that have come before it count.
  explicit ReadyPool(ScheduleState& schedule);

  /// Whether all instances of this rank are complete.
  bool finished() const { return n_left_ == 0; }
  bool empty() const { return ready_.empty(); }
  ScheduleState::Entry& draw(std::mt19937_64& random);
  /// The instance may be another rank's.
  void complete(int instance);

 private:
  /// Entries by instance; null for instances of other ranks.
  std::vector<ScheduleState::Entry*> entries_;
  std::vector<std::vector<int>> successors_;
  std::vector<int> n_awaited_;
  std::vector<ScheduleState::Entry*> ready_;
  int n_left_ = 0;
};

}  // namespace tamp::runtime
