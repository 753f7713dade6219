#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace tamp::runtime
{

class MemoryLedger;

/// Bytes held under one name: now, at most, and when all names together had the most.
class LedgerEntry
{
 public:
  LedgerEntry(std::string name, MemoryLedger* ledger) : name_(std::move(name)), ledger_(ledger) {}

  const std::string& name() const { return name_; }
  std::size_t current() const { return current_.load(std::memory_order_relaxed); }
  std::size_t peak() const { return peak_.load(std::memory_order_relaxed); }
  std::size_t at_high_water() const { return at_high_water_; }

  void add(std::ptrdiff_t bytes);

 private:
  friend class MemoryLedger;

  std::size_t raise(std::ptrdiff_t bytes)
  {
    const std::size_t now = current_.fetch_add(static_cast<std::size_t>(bytes), std::memory_order_relaxed) +
                            static_cast<std::size_t>(bytes);
    std::size_t seen = peak_.load(std::memory_order_relaxed);
    while (now > seen && !peak_.compare_exchange_weak(seen, now, std::memory_order_relaxed)) {
    }
    return now;
  }

  std::string name_;
  MemoryLedger* ledger_;
  std::atomic<std::size_t> current_{0};
  std::atomic<std::size_t> peak_{0};
  std::size_t at_high_water_ = 0;
};

/// Counts the bytes of everything that takes much memory, by label and in all.
class MemoryLedger
{
 public:
  MemoryLedger() = default;
  MemoryLedger(const MemoryLedger&) = delete;
  MemoryLedger& operator=(const MemoryLedger&) = delete;

  /// The entry of that name, made on first use; it stays where it is for the life of the ledger. The ranks of a run
  /// make the same ones in the same order.
  LedgerEntry& entry(const std::string& name)
  {
    const std::lock_guard lock(mutex_);
    for (LedgerEntry& e : entries_) {
      if (e.name() == name) return e;
    }
    return entries_.emplace_back(name, this);
  }

  const LedgerEntry& total() const { return total_; }
  const std::deque<LedgerEntry>& entries() const { return entries_; }

 private:
  friend class LedgerEntry;

  /// Adds bytes to the total, and has every entry keep what it holds when the total is a little above that when they
  /// last did so.
  void add(std::ptrdiff_t bytes)
  {
    const std::size_t now = total_.raise(bytes);
    if (now <= mark_.load(std::memory_order_relaxed)) return;
    const std::lock_guard lock(mutex_);
    if (now <= mark_.load(std::memory_order_relaxed)) return;
    for (LedgerEntry& e : entries_) e.at_high_water_ = e.current();
    constexpr std::size_t a_little = 256;
    mark_.store(now + now / a_little, std::memory_order_relaxed);
  }

  std::mutex mutex_;
  std::deque<LedgerEntry> entries_;
  LedgerEntry total_{"total", nullptr};
  std::atomic<std::size_t> mark_{0};

 public:
  /// Entries of memory that is in no field: the task graph with its records, messages between ranks, copies of state
  /// and fields while they are written, and traced steps.
  LedgerEntry& graph = entry("graph and profile");
  LedgerEntry& messages = entry("messages");
  LedgerEntry& copies = entry("copies for output");
  LedgerEntry& trace = entry("trace");
};

inline void LedgerEntry::add(std::ptrdiff_t bytes)
{
  raise(bytes);
  ledger_->add(bytes);
}

/// Bytes that are held as long as this lives, of memory that tells the ledger nothing by itself.
class LedgerHold
{
 public:
  LedgerHold() = default;
  LedgerHold(LedgerEntry& entry, std::size_t bytes) : entry_(&entry) { hold(bytes); }
  LedgerHold(LedgerHold&& other) noexcept { swap(other); }
  LedgerHold& operator=(LedgerHold&& other) noexcept
  {
    swap(other);
    return *this;
  }
  ~LedgerHold() { hold(0); }

  std::size_t bytes() const { return bytes_; }
  /// Holds so many bytes in place of those before; does nothing without an entry.
  void hold(std::size_t bytes)
  {
    if (entry_ == nullptr || bytes == bytes_) return;
    entry_->add(static_cast<std::ptrdiff_t>(bytes) - static_cast<std::ptrdiff_t>(bytes_));
    bytes_ = bytes;
  }

 private:
  void swap(LedgerHold& other) noexcept
  {
    std::swap(entry_, other.entry_);
    std::swap(bytes_, other.bytes_);
  }

  LedgerEntry* entry_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace tamp::runtime
