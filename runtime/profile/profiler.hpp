#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/clock.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/profile/over_time.hpp"
#include "runtime/profile/profile.hpp"
#include "runtime/profile/replay.hpp"
#include "runtime/profile/task_rows.hpp"
#include "runtime/profile/trace_recorder.hpp"
#include "runtime/profile/worker_waits.hpp"

namespace tamp::runtime
{

/// Gathers the records of a rank's workers after each step, outside of its time. Durations are taken from every step;
/// waits, chains, bytes and particles, which need more looking, from every eighth; processor time from fewer.
class Profiler
{
 public:
  Profiler(const Schedule& schedule, BoundGraph& graph, int n_workers);

  /// Keeps the chosen steps instance by instance, as many as TraceRecorder has room for, and compares the clocks of the
  /// ranks. To be called before the first step. Collective.
  void trace_steps(const TraceChoice& choice, LedgerEntry& memory, const Communicator& communicator = {});
  /// Goes on with the same tasks after the patches have been dealt to the ranks anew.
  void follow(const Schedule& schedule, BoundGraph& graph);
  /// Takes processor time in every `n_steps`-th step; by default 32, as asking the system for it takes about a
  /// microsecond a task.
  void take_processor_time_every(long n_steps) { processor_time_every_ = n_steps; }
  /// Whether the schedule is to take processor time in the next step. Never in the very first, in which memory is
  /// touched for the first time.
  bool takes_processor_time() const
  {
    return n_steps_ > 0 && n_steps_ % processor_time_every_ == 1 % processor_time_every_;
  }
  /// Takes in the records of the step that has just been run.
  void add_step(const StepFacts& facts = {});
  /// See TraceRecorder.
  float wall_to_tell() const { return trace_.wall_to_tell(); }
  /// Processor time of task bodies on each of this rank's patches since the last call, summed over the steps in which
  /// it is taken [s]; 0 for patches of other ranks.
  std::vector<double> take_patch_costs();
  /// The profile of all ranks together. Collective.
  Profile profile(const Communicator& communicator = {}) const;
  /// How many times as long the mean step would be if each run of a task took `factor` times as long, by replay. The
  /// first rank has it; 1 on the others, and where no step was recorded. Collective.
  double step_ratio(const std::string& task, double factor, const Communicator& communicator = {}) const;
  /// The trace of all ranks together. Collective.
  Trace trace(const Communicator& communicator = {}) const;

 private:
  static constexpr long look_every = 8;
  /// Fewest steps with processor time that `core_share` is computed from: among fewer, a single one in which another
  /// program had the core would weigh too much.
  static constexpr long least_samples = 8;

  struct Steps {
    std::uint64_t first_tick = 0;
    std::uint64_t ticks = 0;
    TicksOverTime over_time;
    /// Ticks of all workers in bodies of tasks; filled in only when the profile is made.
    std::uint64_t in_tasks = 0;
    std::uint64_t recording = 0;
    /// Ticks from the end of one step to the start of the next.
    std::uint64_t between = 0;
    // The steps that are looked at: ticks of all of them, and ticks of their longest chains on this rank.
    std::uint64_t looked_at = 0;
    std::uint64_t path_ticks = 0;
    // The steps in which processor time is taken: time of their tasks by the clock [ns], and the processor time that
    // the workers had in it [ns].
    double sampled_ns = 0;
    double processor_ns = 0;
    Traffic traffic;
  };

  void add_durations(const StepFacts& facts);
  bool looks_closely() const { return n_steps_ % look_every == 0; }
  void look_closely();
  void add_processor_times();
  void follow_chain(std::size_t last);
  void add_patch_ticks(std::vector<TaskRow>& rows) const;
  void add_tasks(Profile& profile, const Communicator& communicator, double second) const;
  std::vector<double> per_step(const TicksOverTime& ticks, double second) const;
  void add_steps(Profile& profile, const std::vector<Steps>& of_ranks, double second) const;
  double overhead(const Steps& steps) const;
  double steps_for_each(long n_samples) const;
  double time_for_each_looked_at() const;
  std::vector<Wait> waits(const Communicator& communicator, double second) const;
  TimedStep mean_step(const Communicator& communicator, double second) const;
  std::vector<InstanceTime> times_of(const TimedStep& step) const;
  TimedStep changed(TimedStep step, const std::string& task, double factor) const;
  void replay_mean_step(Profile& profile, const Communicator& communicator, double second) const;
  Traffic traffic() const;

  const Schedule* schedule_;
  BoundGraph* graph_;
  int n_workers_;
  TickRate rate_;
  std::vector<TaskRow> rows_;
  RunParts parts_;
  std::vector<std::size_t> row_of_instance_;
  /// By instance: the longest chain up to its end in a step [ticks]; and `instance_ticks_`, the ticks that it took
  /// since this graph is followed.
  std::vector<std::uint64_t> path_;
  /// By row: the last of the steps looked at, counted from 1, in which it was on the longest chain.
  std::vector<long> on_chain_at_;
  std::vector<std::uint64_t> instance_ticks_;
  long n_followed_ = 0;
  WorkerWaits waits_;
  long n_looked_at_ = 0;
  long processor_time_every_ = 32;
  long n_processor_times_ = 0;
  std::vector<double> patch_costs_;
  TraceRecorder trace_;
  LedgerHold held_by_trace_;
  ClockPair clock_at_begin_;
  long n_steps_ = 0;
  std::uint64_t last_end_ = 0;
  /// Its traffic is that of earlier graphs, before the one that is followed now.
  Steps steps_;
};

}  // namespace tamp::runtime
