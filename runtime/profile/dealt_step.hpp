#pragma once

#include <string>
#include <vector>

#include "runtime/profile/replay.hpp"

namespace tamp::runtime
{

/// The share of a step that one thread of a rank owns; an idle thread takes from others.
struct ThreadShare {
  int rank = 0;
  int thread = 0;
  int n_patches = 0;
  int n_instances = 0;
  /// Time of its instances [s]; 0 where that is not known.
  double work_s = 0;
};

/// A step dealt to `n_threads` threads of each rank.
struct DealtStep {
  int n_threads = 1;
  /// Rank by rank.
  std::vector<ThreadShare> shares;
  /// Number of instances in each level, counted in edges from the start of the step: those of one level can run at
  /// once.
  std::vector<int> levels;
};

DealtStep deal_to_threads(const TaskGraph& graph, int n_threads);
/// The same with the work of each thread.
DealtStep deal_to_threads(const TimedStep& step, int n_threads);

std::string to_text(const DealtStep& dealt);

/// How long the step takes by replay on 1, 2, 4 and so on up to `n_threads` threads a rank, and at least on any number.
/// It was measured on `n_measured` threads, where it took `measured_s`.
std::string replays_text(const TimedStep& step, int n_threads, int n_measured, double measured_s);

}  // namespace tamp::runtime
