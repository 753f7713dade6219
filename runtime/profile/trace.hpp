#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/execute/clock_line.hpp"

namespace tamp::runtime
{

/// A step as one rank ran it. Times here and below are ticks of the rank's own clock, unless they say otherwise.
struct TracedStep {
  /// From 1, over the whole simulation.
  std::int64_t number = 0;
  /// Simulated time [s].
  double size = 0;
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  /// How many of the tape's tasks and messages are the step's: they stand together, in the order of the steps.
  std::uint64_t n_tasks = 0;
  std::uint64_t n_messages = 0;
  /// Messages of the graph, of all ranks: what numbers them over all steps.
  std::uint64_t n_messages_of_all = 0;
};

/// One instance of a task.
struct TracedTask {
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  /// When its last predecessor was done or, of a receiver, its message was there; 0 if it waits for none.
  std::uint64_t ready = 0;
  std::uint64_t bytes = 0;
  std::uint64_t particles = 0;
  /// Its place among the names of the trace.
  std::uint32_t row = 0;
  std::uint32_t worker = 0;
  std::int32_t patch = -1;
  std::int32_t group = -1;
  /// That last predecessor, as its place in the step; -1 if it waits for none here.
  std::int32_t cause = -1;
  /// Of the graph's messages, what it sends or receives; -1 otherwise.
  std::int32_t message = -1;
  bool receives = false;
  /// It found nothing to work on.
  bool skipped = false;
};

/// A message that this rank received.
struct TracedMessage {
  /// On the sender's clock.
  std::uint64_t posted = 0;
  std::uint64_t arrived = 0;
  std::uint64_t unpacked = 0;
  std::uint64_t bytes = 0;
  std::int32_t from_rank = 0;
  std::int32_t message = 0;
  /// The name of what receives it.
  std::uint32_t row = 0;
};

/// What one rank recorded.
struct TraceTape {
  std::vector<TracedStep> steps;
  std::vector<TracedTask> tasks;
  std::vector<TracedMessage> messages;

  void clear();
  std::size_t n_bytes() const;
};

/// Steps of all ranks, task by task.
struct Trace {
  struct Task {
    std::string name;
    std::string category;
  };
  struct Rank {
    std::string machine;
    int n_workers = 1;
    ClockLine clock;
    TraceTape tape;
  };

  std::vector<Task> tasks;
  std::vector<std::string> groups;
  /// On the first rank; elsewhere empty.
  std::vector<Rank> ranks;
  /// When times begin, and how long a tick takes [s], on the first rank's clock.
  std::uint64_t begin = 0;
  double second = 0;
};

}  // namespace tamp::runtime
