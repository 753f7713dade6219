#include "runtime/execute/scheduler/ready_pool.hpp"

#include <utility>

namespace tamp::runtime
{

ReadyPool::ReadyPool(ScheduleState& schedule)
    : entries_(static_cast<std::size_t>(schedule.size())), successors_(entries_.size()), n_awaited_(entries_.size())
{
  for (ScheduleState::List& list : schedule.lists()) {
    for (ScheduleState::Entry& entry : list.entries) {
      const auto i = static_cast<std::size_t>(entry.instance);
      entries_[i] = &entry;
      for (const int p : schedule.work().predecessors(entry.instance)) {
        if (schedule.is_done(p)) continue;
        successors_[static_cast<std::size_t>(p)].push_back(entry.instance);
        ++n_awaited_[i];
      }
      if (n_awaited_[i] == 0) ready_.push_back(&entry);
      ++n_left_;
    }
  }
}

ScheduleState::Entry& ReadyPool::draw(std::mt19937_64& random)
{
  std::swap(ready_[random() % ready_.size()], ready_.back());
  ScheduleState::Entry& entry = *ready_.back();
  ready_.pop_back();
  return entry;
}

void ReadyPool::complete(int instance)
{
  const auto i = static_cast<std::size_t>(instance);
  if (entries_[i] != nullptr) --n_left_;
  for (const int next : successors_[i]) {
    const auto n = static_cast<std::size_t>(next);
    if (--n_awaited_[n] == 0) ready_.push_back(entries_[n]);
  }
}

}  // namespace tamp::runtime
