#include "runtime/execute/schedule.hpp"

#include <numeric>

namespace tamp::runtime
{

namespace
{

/// Two cache lines: processors fetch them in pairs.
constexpr std::size_t flags_between_groups = 32;

}  // namespace

Schedule::Schedule(Work& work, int n_workers)
    : work_(work),
      flag_of_(static_cast<std::size_t>(work.n_instances())),
      lists_(static_cast<std::size_t>(n_workers)),
      records_(flag_of_.size())
{
  lay_out_flags();
  std::vector<std::vector<int>> owned(lists_.size());
  for (int i = 0; i < work.n_instances(); ++i) {
    const int home = work.home(i, n_workers);
    if (home >= 0) owned[static_cast<std::size_t>(home)].push_back(i);
  }
  for (std::size_t worker = 0; worker < lists_.size(); ++worker) {
    lists_[worker].entries = std::vector<Entry>(owned[worker].size());
    for (std::size_t k = 0; k < owned[worker].size(); ++k) fill(lists_[worker].entries[k], owned[worker][k]);
  }
}

/// Of each worker's flags those that only it reads come first, then those that others wait for, too, which so do not
/// draw the former away from its core. What other ranks run comes last, as if it were one worker more.
void Schedule::lay_out_flags()
{
  const auto n_workers = static_cast<int>(lists_.size());
  std::vector<int> homes(flag_of_.size());
  for (int i = 0; i < size(); ++i) {
    const int home = work_.home(i, n_workers);
    homes[static_cast<std::size_t>(i)] = home < 0 ? n_workers : home;
  }
  std::vector<bool> is_shared(homes.size(), false);
  for (std::size_t i = 0; i < homes.size(); ++i) {
    for (const int p : work_.predecessors(static_cast<int>(i))) {
      if (homes[static_cast<std::size_t>(p)] != homes[i]) is_shared[static_cast<std::size_t>(p)] = true;
    }
  }
  std::vector<std::vector<std::size_t>> groups(2 * static_cast<std::size_t>(n_workers + 1));
  for (std::size_t i = 0; i < homes.size(); ++i) {
    groups[2 * static_cast<std::size_t>(homes[i]) + (is_shared[i] ? 1 : 0)].push_back(i);
  }
  std::uint32_t flag = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (g == groups.size() - 2) first_flag_of_others_ = flag;
    for (const std::size_t i : groups[g]) flag_of_[i] = flag++;
    flag += flags_between_groups;
  }
  flags_ = std::vector<std::atomic<Epoch>>(flag);
}

void Schedule::fill(Entry& entry, int instance)
{
  entry.instance = instance;
  entry.flag = flag_of_[static_cast<std::size_t>(instance)];
  entry.first = static_cast<std::uint32_t>(awaited_.size());
  for (const int p : work_.predecessors(instance)) awaited_.push_back(flag_of_[static_cast<std::size_t>(p)]);
  entry.end = static_cast<std::uint32_t>(awaited_.size());
  entry.watch = entry.first;
}

void Schedule::begin_step()
{
  ++epoch_;
  for (List& list : lists_) list.n_reserved.store(0, std::memory_order_relaxed);
}

bool Schedule::arrive(int instance, const InstanceRecord& record)
{
  const auto i = static_cast<std::size_t>(instance);
  if (flags_[flag_of_[i]].fetch_add(1, std::memory_order_release) + 1 != epoch_) return false;
  records_[i] = record;
  return true;
}

std::uint64_t Schedule::progress() const
{
  return std::accumulate(flags_.begin(), flags_.end(), std::uint64_t{0}, [](std::uint64_t sum, const auto& flag) {
    return sum + flag.load(std::memory_order_relaxed);
  });
}

}  // namespace tamp::runtime
