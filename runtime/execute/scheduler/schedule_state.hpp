#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/execute/executor.hpp"
#include "runtime/execute/work.hpp"

namespace tamp::runtime
{

/// Work dealt out to workers, with the flags by which they know what is done.
///
/// Readiness is pulled: an instance is ready when each predecessor's flag shows the number of this step or, of a rank
/// that is ahead, of the next. Flags only grow, so nothing is reset between steps.
class ScheduleState
{
 public:
  using Epoch = std::uint32_t;

  /// An instance as its worker meets it.
  struct Entry {
    int instance = 0;
    /// Its predecessors: from `first` to `end` of `awaited_`.
    std::uint32_t first = 0;
    std::uint32_t end = 0;
    /// The step in which a worker last took it.
    std::atomic<Epoch> claimed{0};
    /// Whether it took so little time in the last step that to share it would cost more.
    std::atomic<bool> is_short{false};
  };
  /// The instances of one worker in serial order: a patch stays with one worker, as its data stay in that core's cache.
  struct alignas(64) List {
    std::vector<Entry> entries;
    /// Number of the first entries that are the owner's alone, see `OwnWalk`.
    std::atomic<std::size_t> n_reserved{0};
    /// The last step of which a worker has seen all entries done.
    std::atomic<Epoch> finished{0};
  };

  ScheduleState(Work& work, int n_workers);

  Work& work() const { return work_; }
  int size() const { return static_cast<int>(flags_.size()); }
  const std::vector<InstanceRecord>& records() const { return records_; }

  /// To be called before each step.
  void begin_step();
  Epoch epoch() const { return epoch_; }
  std::vector<List>& lists() { return lists_; }
  const std::vector<List>& lists() const { return lists_; }
  /// Whether this rank runs it.
  bool is_own(int instance) const { return work_.home(instance, static_cast<int>(lists_.size())) >= 0; }
  /// Steps are compared by their distance, which stays right when the numbers wrap around.
  bool is_done(int instance) const
  {
    const Epoch done = flags_[static_cast<std::size_t>(instance)].load(std::memory_order_acquire);
    return static_cast<std::int32_t>(done - epoch_) >= 0;
  }
  bool is_done(const Entry& entry) const { return is_done(entry.instance); }
  /// Whether all predecessors are done.
  bool is_ready(const Entry& entry) const
  {
    std::uint32_t at = entry.first;
    while (at < entry.end && is_done(awaited_[at])) ++at;
    return at == entry.end;
  }
  /// Whether a worker has taken it. The owner does not say so of what it has reserved.
  bool is_claimed(const Entry& entry) const { return entry.claimed.load() == epoch_; }
  /// Takes the entry for this step unless another worker has.
  bool claim(Entry& entry)
  {
    Epoch claimed = entry.claimed.load(std::memory_order_relaxed);
    return claimed != epoch_ && entry.claimed.compare_exchange_strong(claimed, epoch_);
  }
  void unclaim(Entry& entry) { entry.claimed.store(epoch_ - 1, std::memory_order_release); }
  void complete(const Entry& entry)
  {
    flags_[static_cast<std::size_t>(entry.instance)].store(epoch_, std::memory_order_release);
  }
  void record(Entry& entry, const InstanceRecord& record);
  /// Counts the message of another rank's instance; false if it is already that of the next step.
  bool arrive(int instance, const InstanceRecord& record);
  /// A number that changes whenever an instance is completed or a message comes.
  std::uint64_t progress() const;

 private:
  Work& work_;
  Epoch epoch_ = 0;
  /// Flags by instance.
  std::vector<std::atomic<Epoch>> flags_;
  std::vector<int> awaited_;
  std::vector<List> lists_;
  std::vector<InstanceRecord> records_;
};

inline void ScheduleState::record(Entry& entry, const InstanceRecord& record)
{
  records_[static_cast<std::size_t>(entry.instance)] = record;
  // About a microsecond.
  constexpr std::uint64_t short_ticks = 2000;
  const bool is_short = record.end - record.start < short_ticks;
  if (is_short != entry.is_short) entry.is_short = is_short;
}

}  // namespace tamp::runtime
