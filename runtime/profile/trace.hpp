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
  /// Number of the step, from 1 over the whole simulation.
  std::int64_t number = 0;
  /// Simulated time that the step covers [s].
  double size = 0;
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  /// Number of the tape's tasks and messages that belong to the step: they stand together, in the order of the steps.
  std::uint64_t n_tasks = 0;
  std::uint64_t n_messages = 0;
  /// Number of messages in the graph, of all ranks; messages are numbered with it over all steps.
  std::uint64_t n_messages_of_all = 0;
};

/// One instance of a task.
struct TracedTask {
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  /// When its last predecessor was done or, for a receiver, when its message was there; 0 if it waits for none.
  std::uint64_t ready = 0;
  std::uint64_t bytes = 0;
  std::uint64_t particles = 0;
  /// Its place among the names of the trace.
  std::uint32_t row = 0;
  std::uint32_t worker = 0;
  std::int32_t patch = -1;
  std::int32_t group = -1;
  /// Index in the step of that last predecessor; -1 if it waits for none here.
  std::int32_t cause = -1;
  /// Index in the graph of the message that it sends or receives; -1 if none.
  std::int32_t message = -1;
  bool receives = false;
  /// It found nothing to work on.
  bool skipped = false;
};

/// A message that this rank received.
struct TracedMessage {
  /// When it was posted, on the sender's clock.
  std::uint64_t posted = 0;
  std::uint64_t arrived = 0;
  std::uint64_t unpacked = 0;
  std::uint64_t bytes = 0;
  std::int32_t from_rank = 0;
  std::int32_t message = 0;
  /// Index of the receiving task's name among those of the trace.
  std::uint32_t row = 0;
};

/// The records of one rank.
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
  /// The records of all ranks, on the first rank; elsewhere empty.
  std::vector<Rank> ranks;
  /// When times begin, and how long a tick takes [s], on the first rank's clock.
  std::uint64_t begin = 0;
  double second = 0;
};

}  // namespace tamp::runtime
