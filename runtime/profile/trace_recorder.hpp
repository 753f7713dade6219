#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/profile/trace.hpp"
#include "runtime/profile/trace_choice.hpp"

namespace tamp::runtime
{

/// Facts about a step that has been run, as the host knows them.
struct StepFacts {
  /// Number of the step, from 1 over the whole simulation; and the simulated time that it covers [s].
  std::int64_t number = 0;
  double size = 0;
  /// How long the step before took by the clock on the rank where it took longest [s]; for the slowest step alone.
  float previous_wall = 0;
};

/// Keeps the chosen steps of one rank, task by task. All ranks keep the same steps: they choose by what all of them
/// know. How long a step took on all ranks is known one step later; so the last step is kept until then, beside the
/// slowest.
class TraceRecorder
{
 public:
  /// Tasks that all ranks together keep at most, some 80 bytes each; twice as many for the slowest step.
  static constexpr std::size_t most_tasks = 300'000;

  void choose(const TraceChoice& choice) { choice_ = choice; }
  const TraceChoice& choice() const { return choice_; }
  /// From now on steps are those of this graph; `row_of_instance` outlives it.
  void follow(const BoundGraph& graph, const std::vector<std::size_t>& row_of_instance);
  /// Takes in the records of a step that ran from `start` to `end` [ticks], in `wall` seconds.
  void add_step(const StepFacts& facts, const std::vector<InstanceRecord>& records, std::uint64_t start,
                std::uint64_t end, float wall);
  /// Wall time of the last step on this rank [s], which all ranks are to be told; 0 where no slowest step is wanted.
  float wall_to_tell() const { return wall_; }
  /// The steps that are kept, which are the same on all ranks. Collective.
  const TraceTape& tape(const Communicator& communicator) const;
  /// Number of steps that are kept.
  std::size_t n_steps() const;
  std::size_t n_bytes() const { return kept_.n_bytes() + last_.n_bytes(); }

 private:
  bool is_wanted(const StepFacts& facts);
  void settle(float previous_wall);
  void record(TraceTape& tape, const TracedStep& step, const std::vector<InstanceRecord>& records) const;
  TracedTask task_of(int instance, const std::vector<InstanceRecord>& records) const;
  TracedMessage message_of(int message, const std::vector<InstanceRecord>& records) const;

  TraceChoice choice_;
  const BoundGraph* graph_ = nullptr;
  const std::vector<std::size_t>* row_of_instance_ = nullptr;
  /// This rank's instances, and for each instance its place among them; -1 for those of other ranks.
  std::vector<int> local_;
  std::vector<std::int32_t> place_;
  TraceTape kept_;
  std::int64_t n_run_ = 0;
  /// Number of tasks of all ranks in the steps kept.
  std::size_t n_tasks_ = 0;
  // For the slowest step: the last one, how long it took here, and how long the one kept took [s].
  TraceTape last_;
  float wall_ = 0;
  float slowest_ = -1;
};

/// Brings what all ranks have kept to the first, with their clocks and the names of their machines. Collective.
std::vector<Trace::Rank> gather_tapes(const TraceTape& own, const ClockLine& clock, int n_workers,
                                      const Communicator& communicator);

}  // namespace tamp::runtime
