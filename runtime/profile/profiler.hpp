#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/clock.hpp"
#include "runtime/execute/executor.hpp"

namespace tamp::runtime
{

/// How long the instances of one task took, kept as counts by length: 32 bins an octave, so that a quantile is known
/// to about 2 %.
class DurationHistogram
{
 public:
  void add(std::uint64_t ticks);
  std::uint64_t count() const { return count_; }
  std::uint64_t total() const { return total_; }
  std::uint64_t least() const { return count_ == 0 ? 0 : least_; }
  std::uint64_t most() const { return most_; }
  void merge(const DurationHistogram& other);
  /// The length that a share of `q` (0..1) of all does not pass.
  double quantile(double q) const;

 private:
  static constexpr int bins_per_octave = 32;

  std::uint64_t count_ = 0;
  std::uint64_t total_ = 0;
  std::uint64_t least_ = ~std::uint64_t{0};
  std::uint64_t most_ = 0;
  std::array<std::uint32_t, 48 * bins_per_octave> bins_{};
};

/// One row of the profile. Times in seconds.
struct TaskStatistics {
  std::string name;
  std::uint64_t count = 0;
  /// Instances that found nothing to work on; they are in none of the other numbers but the wait.
  std::uint64_t skipped = 0;
  double total_s = 0;
  double mean_s = 0;
  double min_s = 0;
  double max_s = 0;
  double p95_s = 0;
  /// Part of the time of all tasks; the shares of all rows add up to 1.
  double share = 0;
  double bytes = 0;
  double particles = 0;
  /// Time of the busiest patch over the mean of all patches.
  double imbalance = 1;
  /// Between the end of the last predecessor and the start, summed.
  double wait_s = 0;
};

/// One instance in the trace; times in seconds since the profile began.
struct TraceEvent {
  /// Its place among the names of the trace.
  std::size_t task = 0;
  int rank = 0;
  int patch = 0;
  int group = 0;
  std::uint32_t worker = 0;
  double start_s = 0;
  double end_s = 0;
};

/// The first steps, instance by instance.
struct Trace {
  std::vector<std::string> tasks;
  std::vector<TraceEvent> events;
};

struct Profile {
  /// Most expensive first.
  std::vector<TaskStatistics> tasks;
  long n_steps = 0;
  long n_traced_steps = 0;
  /// Mean time of a step, of its longest chain of tasks, and the share of the workers' time outside of task bodies.
  double step_s = 0;
  double critical_path_s = 0;
  double overhead = 0;
  /// Messages between ranks: how many, how long, how long on their way in sum, and the part of that in which the worker
  /// that took them in had nothing else to run.
  std::uint64_t n_messages = 0;
  std::uint64_t message_bytes = 0;
  double message_s = 0;
  double message_wait_s = 0;
};

/// Gathers what the workers of a rank recorded, after each step and outside of it.
class Profiler
{
 public:
  /// Instances that all ranks together trace at most: as JSON some 30 MB.
  static constexpr std::size_t most_traced = 300'000;

  Profiler(const Schedule& schedule, BoundGraph& graph, int n_workers);

  /// Keeps the first `n_steps` steps instance by instance; fewer where these would be more than `most_traced`, by
  /// the number of all instances of a step. To be called before the first step.
  void trace_steps(long n_steps) { n_traced_steps_ = n_steps; }
  /// Goes on with the same tasks on patches dealt anew.
  void follow(const Schedule& schedule, BoundGraph& graph);
  /// Takes in the records of the step that has just been run.
  void add_step();
  /// Ticks that task bodies took on each of this rank's patches since this was last asked; 0 on others.
  std::vector<double> take_patch_costs();
  /// The profile of all ranks together. Collective.
  Profile profile(const Communicator& communicator = {}) const;
  /// The trace of all ranks together. Collective.
  Trace trace(const Communicator& communicator = {}) const;

 private:
  /// Numbers of one task, which may be sent as bytes.
  struct Totals {
    DurationHistogram durations;
    std::uint64_t skipped = 0;
    std::uint64_t wait = 0;
    double bytes = 0;
    double particles = 0;
  };
  struct Row {
    std::string name;
    Totals totals;
    std::vector<std::uint64_t> per_patch;
  };
  struct TracedInstance {
    std::size_t row;
    int patch;
    int group;
    InstanceRecord record;
  };
  struct Steps {
    std::uint64_t first_tick = 0;
    std::uint64_t ticks = 0;
    std::uint64_t path_ticks = 0;
    Traffic traffic;
  };

  std::vector<Row> rows_of_all(const Communicator& communicator) const;
  TaskStatistics statistics(const Row& row, std::uint64_t all_ticks, double second) const;
  bool is_traced(long step) const;
  Traffic traffic() const;

  const Schedule* schedule_;
  BoundGraph* graph_;
  int n_workers_;
  long n_traced_steps_ = 0;
  TickRate rate_;
  std::vector<Row> rows_;
  std::vector<std::size_t> row_of_instance_;
  std::vector<std::uint64_t> path_;
  std::vector<double> patch_costs_;
  std::vector<TracedInstance> traced_;
  long n_steps_ = 0;
  /// With the traffic of the graphs before the one that is followed now.
  Steps steps_;
};

}  // namespace tamp::runtime
