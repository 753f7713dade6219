#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/execute/work.hpp"

namespace tamp::runtime
{

/// When and where an instance ran in the last step, in ticks.
struct InstanceRecord {
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::uint32_t worker = 0;
};

/// Work dealt out to workers, with the flags by which they know what is done.
///
/// Readiness is pulled: an instance is ready when each predecessor's flag shows the number of this step. Flags only
/// grow, so nothing is reset between steps, and each lies on a cache line of its own.
class Schedule
{
 public:
  Schedule(Work& work, int n_workers);

  Work& work() { return work_; }
  int size() const { return static_cast<int>(slots_.size()); }
  const std::vector<InstanceRecord>& records() const { return records_; }
  /// Off only to measure what recording costs.
  bool recording = true;

 private:
  friend class Executor;

  struct alignas(64) Slot {
    std::atomic<std::uint32_t> claimed{0};
    std::atomic<std::uint32_t> done{0};
    std::span<const int> predecessors;
  };

  Work& work_;
  std::uint32_t epoch_ = 0;
  std::vector<Slot> slots_;
  /// Instances by home worker, in serial order: a patch stays with one worker, as its data stay in that core's cache.
  std::vector<std::vector<int>> lists_;
  std::vector<InstanceRecord> records_;
};

}  // namespace tamp::runtime
