#pragma once

#include <algorithm>
#include <cstddef>

#include "runtime/execute/scheduler/schedule_state.hpp"

namespace tamp::runtime
{

/// A worker's way through its own list: in order while it can, past what is blocked when it must.
///
/// To claim an entry is an atomic exchange, which has to wait until the other cores know all that this one has written.
/// So the owner reserves short instances, several with one exchange, and gives up what is left when it finds nothing to
/// run; docs/findings/what_a_task_costs.md says what that brings. Another worker claims first and then looks at the
/// reservation, the owner the other way around: one of the two sees the other.
class OwnWalk
{
 public:
  /// Looks at no more than `window` entries, from the first that is not done. `alone` is a worker without others.
  OwnWalk(ScheduleState& schedule, ScheduleState::List& list, std::size_t window, bool alone)
      : schedule_(schedule), list_(list), window_(window), n_reserved_(alone ? list.entries.size() : 0), alone_(alone)
  {
  }

  bool finished() const { return head_ == list_.entries.size(); }

  /// Takes an entry that is ready; null if there is none. An entry passed over is looked at again before each other.
  ScheduleState::Entry* next()
  {
    auto& entries = list_.entries;
    while (head_ < entries.size() && schedule_.is_done(entries[head_])) ++head_;
    if (head_ == entries.size()) {
      list_.finished.store(schedule_.epoch(), std::memory_order_release);
      return nullptr;
    }
    if (take(head_)) return &entries[head_];
    const std::size_t end = std::min(entries.size(), head_ + window_);
    if (ahead_ <= head_ || ahead_ >= end) ahead_ = head_ + 1;
    while (ahead_ < end) {
      if (take(ahead_++)) return &entries[ahead_ - 1];
    }
    release();
    return nullptr;
  }

 private:
  bool take(std::size_t k)
  {
    ScheduleState::Entry& entry = list_.entries[k];
    if (schedule_.is_done(entry) || schedule_.is_claimed(entry) || !schedule_.is_ready(entry)) return false;
    if (k >= n_reserved_) reserve(k);
    return k < n_reserved_ ? !schedule_.is_claimed(entry) : schedule_.claim(entry);
  }

  /// Reserves the entry and the next few, as far as all of them are short.
  void reserve(std::size_t k)
  {
    constexpr std::size_t n_ahead = 16;
    const auto& entries = list_.entries;
    const std::size_t most = std::min(entries.size(), k + n_ahead);
    std::size_t n = std::max(n_reserved_, head_);
    while (n < most && entries[n].is_short) ++n;
    if (n <= k) return;
    n_reserved_ = n;
    list_.n_reserved.exchange(n);
  }
  /// So that nobody waits for a worker that the system has put aside.
  void release()
  {
    if (alone_ || n_reserved_ == 0) return;
    n_reserved_ = 0;
    list_.n_reserved.store(0, std::memory_order_release);
  }

  ScheduleState& schedule_;
  ScheduleState::List& list_;
  std::size_t window_;
  std::size_t head_ = 0;
  std::size_t ahead_ = 0;
  std::size_t n_reserved_;
  bool alone_;
};

/// A worker's way through another's list: backwards from the far end of the window, where it is least in the owner's
/// way.
class OthersWalk
{
 public:
  OthersWalk(ScheduleState& schedule, ScheduleState::List& list, std::size_t window)
      : schedule_(schedule), list_(list), window_(window)
  {
  }

  bool finished() const { return list_.finished.load(std::memory_order_acquire) == schedule_.epoch(); }

  /// Takes an entry that is ready; null if there is none between the last one taken and the owner's first.
  ScheduleState::Entry* next()
  {
    auto& entries = list_.entries;
    while (head_ < entries.size() && schedule_.is_done(entries[head_])) ++head_;
    if (head_ == entries.size()) list_.finished.store(schedule_.epoch(), std::memory_order_release);
    if (at_ <= head_) at_ = std::min(entries.size(), head_ + window_);
    const std::size_t first = std::max(head_, list_.n_reserved.load(std::memory_order_relaxed));
    while (at_ > first) {
      if (take(--at_)) return &entries[at_];
    }
    at_ = head_;
    return nullptr;
  }

 private:
  bool take(std::size_t k)
  {
    ScheduleState::Entry& entry = list_.entries[k];
    if (schedule_.is_done(entry) || schedule_.is_claimed(entry) || !schedule_.is_ready(entry) ||
        !schedule_.claim(entry)) {
      return false;
    }
    // The owner may have reserved it, and run it and released it, since it was looked at.
    if (k >= list_.n_reserved.load() && !schedule_.is_done(entry)) return true;
    schedule_.unclaim(entry);
    return false;
  }

  ScheduleState& schedule_;
  ScheduleState::List& list_;
  std::size_t window_;
  std::size_t head_ = 0;
  std::size_t at_ = 0;
};

}  // namespace tamp::runtime
