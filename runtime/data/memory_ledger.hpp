#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace tamp::runtime
{

/// Bytes held under one name, now and at most.
class LedgerEntry
{
 public:
  explicit LedgerEntry(std::string name) : name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  std::size_t current() const { return current_.load(std::memory_order_relaxed); }
  std::size_t peak() const { return peak_.load(std::memory_order_relaxed); }

  void add(std::ptrdiff_t bytes)
  {
    const std::size_t now = current_.fetch_add(static_cast<std::size_t>(bytes), std::memory_order_relaxed) +
                            static_cast<std::size_t>(bytes);
    std::size_t seen = peak_.load(std::memory_order_relaxed);
    while (now > seen && !peak_.compare_exchange_weak(seen, now, std::memory_order_relaxed)) {
    }
  }

 private:
  std::string name_;
  std::atomic<std::size_t> current_{0};
  std::atomic<std::size_t> peak_{0};
};

/// Every allocation of field data passes through here, so that memory is known by label and in all.
class MemoryLedger
{
 public:
  /// The entry of that name, made on first use; it stays where it is for the life of the ledger.
  LedgerEntry& entry(const std::string& name)
  {
    const std::lock_guard lock(mutex_);
    for (LedgerEntry& e : entries_) {
      if (e.name() == name) return e;
    }
    return entries_.emplace_back(name);
  }

  LedgerEntry& total() { return total_; }
  const LedgerEntry& total() const { return total_; }
  const std::deque<LedgerEntry>& entries() const { return entries_; }

 private:
  std::mutex mutex_;
  std::deque<LedgerEntry> entries_;
  LedgerEntry total_{"total"};
};

}  // namespace tamp::runtime
