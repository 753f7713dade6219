#pragma once

#include <vector>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// A step with the time that each instance and message takes [s]: the mean of many steps, for instance.
struct TimedStep {
  const TaskGraph* graph = nullptr;
  /// Time of each instance [s].
  std::vector<double> instance_s;
  /// Time of each message from being sent to being seen [s].
  std::vector<double> message_s;
};

/// The worker that owns each instance where each rank has `n_workers` of them, as rank times `n_workers` plus worker.
/// Consecutive patches belong to one worker, and instances of a rank as a whole to its first worker, as in
/// BoundGraph::home.
std::vector<int> homes_of(const TaskGraph& graph, int n_workers);

/// How long a step takes [s] on `n_workers` threads a rank: what the executor would do, without doing it. Every patch
/// has its worker, which runs what is ready in serial order, and takes from others when idle. Neither
/// the scheduler nor the record take time here.
double replay(const TimedStep& step, int n_workers);

/// The instances of the longest chain of tasks and messages, first to last, and its length.
struct Chain {
  std::vector<int> instances;
  /// By instance of the chain: how long the message before it was on its way; 0 where there is none.
  std::vector<double> message_s;
  double length_s = 0;
};
Chain longest_chain(const TimedStep& step);

}  // namespace tamp::runtime
