#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/data/heap.hpp"
#include "runtime/execute/step_graphs.hpp"
#include "runtime/profile/profiler.hpp"
#include "runtime/ranks/load_balance.hpp"
#include "runtime/storage/checkpoints/checkpoint.hpp"

namespace tamp::runtime
{

/// How far a run has come.
struct Progress {
  std::int64_t n_steps = 0;
  double time = 0;       ///< s
  double step_size = 0;  ///< of the last step [s]
};

/// The runtime's front door: runs the steps of a simulation on threads and ranks. docs/tutorials/first_task_graph.md is
/// a tour.
///
/// The first graph is the step, which makes the state that the next one reads; the others read that state too, and make
/// results. All that changes from step to step is state, in the warehouse: a checkpoint holds it, and it moves along
/// where patches are dealt to other ranks. All calls are collective unless they say otherwise.
class Engine
{
 public:
  /// `executor` must outlive the engine. Throws GraphError with every mistake that the tasks hold, and for a layout
  /// that is dealt to other ranks than the communicator's.
  Engine(const PatchLayout& layout, std::vector<std::string> group_names, std::vector<GraphTasks> graphs,
         Executor& executor, const Communicator& communicator = {});

  /// Runs one step of `size` [s], or as much less as it takes to end at `end`. False if its tasks refuse it
  /// (step_verdict): the state is then that of before, on all ranks, and another step may be tried.
  ///
  /// A StepError that a task throws is thrown on all ranks, and the state is then still that of before, unless
  /// particles migrate without waiting for a check. Any other failure is thrown as TaskError, or on several ranks,
  /// which cannot go on then, as std::runtime_error.
  bool advance(double size, double end = std::numeric_limits<double>::infinity());
  /// Runs another graph, for its results. Its tasks see a step of `size` [s]: that of the next, if they look ahead.
  void run(std::size_t graph, double size = 0);

  const Progress& progress() const;

  /// Bits that this rank's host tells all ranks with the next step, or within eight if it has no patches; not
  /// collective.
  void ask(unsigned requests) { requests_ |= requests; }
  /// Requests of any rank with the last step; not collective.
  unsigned asked() const { return asked_; }

  /// Looks at the load of the ranks every `n_steps` steps; two looks in a row that find too much of it on one rank deal
  /// the patches anew. With 0 patches stay where they are. References to the layout and the graphs do not outlive a
  /// deal.
  void balance_every(long n_steps);
  const std::vector<Rebalance>& rebalances() const { return balance_.rebalances(); }
  /// Gives each patch, between steps, to the rank that stands at its place in `ranks`; see PatchLayout::give_to_ranks.
  void deal(const std::vector<int>& ranks);

  /// The profile of the steps so far on all ranks.
  Profile profile() const { return profiler_.profile(communicator_); }
  /// How many times as long a step would be if each run of a task took `factor` times as long; see Profiler.
  double step_ratio(const std::string& task, double factor) const
  {
    return profiler_.step_ratio(task, factor, communicator_);
  }
  /// Which steps are traced, before the first of them; none if it was not called.
  void trace_steps(const TraceChoice& choice)
  {
    profiler_.trace_steps(choice, warehouse_.ledger().trace, communicator_);
  }
  /// The trace of those steps; the first rank has it.
  Trace trace() const { return profiler_.trace(communicator_); }
  /// Off only to measure what recording costs.
  void record(bool on) { schedule().recording = on; }

  /// Keeps the state in a folder, with bytes of the host's own, which are the same on all ranks; see
  /// runtime::write_checkpoint. Throws FileError.
  void write_checkpoint(const std::filesystem::path& folder, const std::string& fingerprint,
                        std::span<const std::byte> host, int keep);
  /// A checkpoint in two parts: a copy, on the first rank, which that rank may write when and in which thread it likes.
  CheckpointCopy copy_checkpoint(const std::string& fingerprint, std::span<const std::byte> host);
  /// Goes on where a checkpoint of the same graphs was written, on any ranks; returns the host's bytes.
  std::vector<std::byte> restart(const FoundCheckpoint& found);

  const Communicator& communicator() const { return communicator_; }
  Executor& executor() const { return executor_; }
  const PatchLayout& layout() const { return compiled_->layout; }
  /// The state and the results, for the host between steps.
  Warehouse& warehouse() { return warehouse_; }
  const Warehouse& warehouse() const { return warehouse_; }
  const TaskGraph& graph(std::size_t i = 0) const { return compiled_->graphs[i]; }
  std::vector<const TaskGraph*> graphs() const { return compiled_->pointers(); }
  BoundGraph& bound(std::size_t i = 0) { return ready_->bound[i]; }
  Schedule& schedule(std::size_t i = 0) { return ready_->schedules[i]; }

 private:
  Progress& now();
  std::ptrdiff_t beyond_ledger() const;
  std::unique_ptr<CompiledGraphs> compiled_on(const PatchLayout& layout) const;
  std::unique_ptr<ReadyGraphs> ready(const CompiledGraphs& compiled);
  void run_step(const Step& step);
  bool was_refused();
  void balance_if_due();
  void look_for_idle_ranks();
  void hear_idle_ranks();
  CheckpointHeader header(const std::string& fingerprint) const;

  /// Heap of the program before the engine was made [bytes].
  std::size_t heap_at_start_ = heap_bytes();
  std::vector<std::string> group_names_;
  std::vector<GraphTasks> tasks_;
  Executor& executor_;
  Communicator communicator_;
  /// Communicator on which ranks that failed at different places meet; it has no other messages.
  Communicator after_failure_;
  RankClocks clocks_;
  std::unique_ptr<CompiledGraphs> compiled_;
  Warehouse warehouse_;
  std::unique_ptr<ReadyGraphs> ready_;
  Profiler profiler_;
  LoadBalance balance_;
  LedgerHold held_by_graph_;
  unsigned requests_ = 0;
  unsigned asked_ = 0;
  /// Whether this rank, and whether any, has no patches.
  bool is_idle_ = false;
  bool some_are_idle_ = false;
};

}  // namespace tamp::runtime
