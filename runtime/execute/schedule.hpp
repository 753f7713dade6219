#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/execute/work.hpp"

namespace tamp::runtime
{

/// When and where an instance ran in the last step, in ticks; of another rank's, when its message came.
struct InstanceRecord {
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::uint32_t worker = 0;
};

/// Work dealt out to workers, with the flags by which they know what is done.
///
/// Readiness is pulled: an instance is ready when each predecessor's flag shows the number of this step or, of a rank
/// that is ahead, of the next. Flags only grow, so nothing is reset between steps.
class Schedule
{
 public:
  using Epoch = std::uint32_t;

  /// An instance as its worker meets it.
  struct Entry {
    int instance = 0;
    std::uint32_t flag = 0;
    /// Flags of the predecessors: from `first` to `end` of `awaited_`.
    std::uint32_t first = 0;
    std::uint32_t end = 0;
    /// The first of them not known to be done: each is looked at until it is, then never again. The owner moves it.
    std::atomic<std::uint32_t> watch{0};
    /// The step in which a worker last took it.
    std::atomic<Epoch> claimed{0};
    /// Whether it took so little time in the last step that to share it would cost more.
    std::atomic<bool> is_short{false};
  };
  /// One worker's instances in serial order: a patch stays with one worker, as its data stay in that core's cache.
  struct alignas(64) List {
    std::vector<Entry> entries;
    /// So many of the first are the owner's alone, see `OwnWalk`.
    std::atomic<std::size_t> n_reserved{0};
    /// The last step of which a worker has seen all entries done.
    std::atomic<Epoch> finished{0};
  };

  Schedule(Work& work, int n_workers);

  Work& work() const { return work_; }
  int size() const { return static_cast<int>(flag_of_.size()); }
  const std::vector<InstanceRecord>& records() const { return records_; }
  /// Off only to measure what recording costs.
  bool recording = true;

  // What follows is for the executor, which calls `begin_step` before each step.
  void begin_step();
  Epoch epoch() const { return epoch_; }
  std::vector<List>& lists() { return lists_; }
  const std::vector<List>& lists() const { return lists_; }
  /// Whether this rank runs it.
  bool is_own(int instance) const { return flag_of_[static_cast<std::size_t>(instance)] < first_flag_of_others_; }
  bool is_done(int instance) const { return is_up(flag_of_[static_cast<std::size_t>(instance)]); }
  bool is_done(const Entry& entry) const { return is_up(entry.flag); }
  /// Whether all predecessors are done; keeps in `watch` how far they are.
  bool is_ready(Entry& entry);
  /// The same for a worker that does not own the entry.
  bool is_ready_for_others(const Entry& entry) const;
  /// Whether a worker has taken it. The owner does not say so of what it has reserved.
  bool is_claimed(const Entry& entry) const { return entry.claimed.load() == epoch_; }
  /// Takes the entry for this step unless another worker has.
  bool claim(Entry& entry)
  {
    Epoch claimed = entry.claimed.load(std::memory_order_relaxed);
    return claimed != epoch_ && entry.claimed.compare_exchange_strong(claimed, epoch_);
  }
  void unclaim(Entry& entry) { entry.claimed.store(epoch_ - 1, std::memory_order_release); }
  void complete(const Entry& entry) { flags_[entry.flag].store(epoch_, std::memory_order_release); }
  void record(Entry& entry, const InstanceRecord& record);
  /// Counts the message of another rank's instance; false if it is already that of the next step.
  bool arrive(int instance, const InstanceRecord& record);
  /// A number that changes whenever an instance is completed or a message comes.
  std::uint64_t progress() const;

 private:
  void lay_out_flags();
  void fill(Entry& entry, int instance);
  /// Steps are compared by their distance, which stays right when the numbers wrap around.
  bool is_up(std::uint32_t flag) const
  {
    return static_cast<std::int32_t>(flags_[flag].load(std::memory_order_acquire) - epoch_) >= 0;
  }
  std::uint32_t first_not_up(std::uint32_t from, std::uint32_t end) const
  {
    while (from < end && is_up(awaited_[from])) ++from;
    return from;
  }

  Work& work_;
  Epoch epoch_ = 0;
  /// In groups with gaps between them, so that no cache line is in two: see `lay_out_flags`.
  std::vector<std::atomic<Epoch>> flags_;
  std::vector<std::uint32_t> flag_of_;
  std::uint32_t first_flag_of_others_ = 0;
  std::vector<std::uint32_t> awaited_;
  std::vector<List> lists_;
  std::vector<InstanceRecord> records_;
};

inline void Schedule::record(Entry& entry, const InstanceRecord& record)
{
  records_[static_cast<std::size_t>(entry.instance)] = record;
  // About a microsecond.
  constexpr std::uint64_t short_ticks = 2000;
  const bool is_short = record.end - record.start < short_ticks;
  if (is_short != entry.is_short) entry.is_short = is_short;
}

inline bool Schedule::is_ready(Entry& entry)
{
  const std::uint32_t from = entry.watch.load(std::memory_order_relaxed);
  const std::uint32_t to = first_not_up(from, entry.end);
  if (to == entry.end) return true;
  // Released, so that another worker who starts from here sees what the passed predecessors did.
  if (to != from) entry.watch.store(to, std::memory_order_release);
  return false;
}

inline bool Schedule::is_ready_for_others(const Entry& entry) const
{
  return first_not_up(entry.watch.load(std::memory_order_acquire), entry.end) == entry.end;
}

}  // namespace tamp::runtime
