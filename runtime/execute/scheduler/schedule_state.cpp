#include "runtime/execute/scheduler/schedule_state.hpp"

#include <numeric>

namespace tamp::runtime
{

ScheduleState::ScheduleState(Work& work, int n_workers)
    : work_(work),
      flags_(static_cast<std::size_t>(work.n_instances())),
      lists_(static_cast<std::size_t>(n_workers)),
      records_(flags_.size())
{
  std::vector<std::vector<int>> owned(lists_.size());
  for (int i = 0; i < work.n_instances(); ++i) {
    const int home = work.home(i, n_workers);
    if (home >= 0) owned[static_cast<std::size_t>(home)].push_back(i);
  }
  for (std::size_t worker = 0; worker < lists_.size(); ++worker) {
    lists_[worker].entries = std::vector<Entry>(owned[worker].size());
    for (std::size_t k = 0; k < owned[worker].size(); ++k) {
      Entry& entry = lists_[worker].entries[k];
      const std::span<const int> predecessors = work.predecessors(owned[worker][k]);
      entry.instance = owned[worker][k];
      entry.first = static_cast<std::uint32_t>(awaited_.size());
      awaited_.insert(awaited_.end(), predecessors.begin(), predecessors.end());
      entry.end = static_cast<std::uint32_t>(awaited_.size());
    }
  }
}

void ScheduleState::begin_step()
{
  ++epoch_;
  for (List& list : lists_) list.n_reserved.store(0, std::memory_order_relaxed);
}

bool ScheduleState::arrive(int instance, const InstanceRecord& record)
{
  const auto i = static_cast<std::size_t>(instance);
  if (flags_[i].fetch_add(1, std::memory_order_release) + 1 != epoch_) return false;
  records_[i] = record;
  return true;
}

std::uint64_t ScheduleState::progress() const
{
  return std::accumulate(flags_.begin(), flags_.end(), std::uint64_t{0}, [](std::uint64_t sum, const auto& flag) {
    return sum + flag.load(std::memory_order_relaxed);
  });
}

}  // namespace tamp::runtime
