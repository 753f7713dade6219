#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/execute/watchdog.hpp"
#include "runtime/execute/work.hpp"

/// The scheduler, as the rest of the program sees it; how it works is in `scheduler/`.
namespace tamp::runtime
{

/// When and where an instance ran in the last step [ticks]; for an instance of another rank, when its message came.
struct InstanceRecord {
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::uint32_t worker = 0;
  /// Processor time of the body [ns], where the schedule asks for it: another program may have had the core.
  std::uint32_t processor_ns = 0;
};

class ScheduleState;

/// Work dealt out to workers, to be run again and again.
class Schedule
{
 public:
  Schedule(Work& work, int n_workers);
  ~Schedule();
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  /// Records of the last step, by instance.
  const std::vector<InstanceRecord>& records() const;
  /// Off only to measure what recording costs.
  bool recording = true;
  /// Whether the next run takes processor times.
  bool taking_processor_time = false;

 private:
  friend class Executor;
  std::unique_ptr<ScheduleState> state_;
};

/// An error in a task, with its name; `cause` is the exception that its body threw.
struct TaskError : std::runtime_error {
  TaskError(const std::string& where, const std::string& what, std::exception_ptr cause_)
      : std::runtime_error(where + ": " + what), cause(std::move(cause_))
  {
  }
  std::exception_ptr cause;
};

/// How an executor waits, in which order it runs what is ready, and when it gives up.
struct ExecutorOptions {
  /// More workers than cores, those of all ranks counted: who waits then sleeps instead of spinning.
  bool oversubscribed = false;
  /// How many instances a worker looks at when the first is blocked. With 1, and one thread, instances run in program
  /// order even if that means to wait for a message.
  std::size_t window = 64;
  /// How a run in which nothing completes is ended.
  StallOptions stall = {};
};

/// Runs schedules on oneTBB threads, which stay with it from step to step in an arena of their own. The program's other
/// uses of oneTBB, further executors among them, keep the threads that they would have without it.
///
/// Graphs over several ranks run one at a time, as MPI is called by one thread at a time (MPI_THREAD_SERIALIZED).
class Executor
{
 public:
  /// `n_threads` counts the caller, who works too. With one thread instances run in program order, but for those that
  /// wait for messages.
  explicit Executor(int n_threads, ExecutorOptions options = {});
  /// An executor of one thread, which takes any of the instances that are ready, drawn anew in each step: an order that
  /// the graph allows by mistake shows as another result.
  static std::unique_ptr<Executor> shuffled(std::uint64_t seed, ExecutorOptions options = {});
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int n_threads() const;

  /// Runs every instance of the schedule once, each as soon as its predecessors are done, and returns when all are.
  /// An exception of a task stops all workers and is thrown here as a TaskError, one of `Work::poll` as it is; the
  /// schedule is spent then. Throws std::logic_error where another graph with messages is running.
  void run(Schedule& schedule, const Step& step);

  /// Between runs: has the watchdog see to it that what the host does meanwhile, with other ranks, ends in time.
  Watchdog::Watch watch(const char* activity);

  /// Has the state of the run printed within a tenth of a second. May be called from a signal handler.
  void request_report() noexcept;

 private:
  class Workers;
  std::unique_ptr<Workers> workers_;
};

}  // namespace tamp::runtime
