#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/execute/clock.hpp"
#include "runtime/execute/crew.hpp"
#include "runtime/execute/schedule.hpp"
#include "runtime/execute/stall_report.hpp"
#include "runtime/execute/walk.hpp"
#include "runtime/execute/watchdog.hpp"

namespace tamp::runtime
{

/// What went wrong in which task; `cause` is the exception that its body threw.
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
  /// What is done about a run in which nothing completes.
  StallOptions stall = {};
};

/// Runs schedules on oneTBB threads, see `Crew`.
class Executor
{
 public:
  /// `n_threads` counts the caller, who works too. With one thread instances run in program order, but for those that
  /// wait for messages.
  explicit Executor(int n_threads, ExecutorOptions options = {});
  /// One thread, which takes any of the instances that are ready, drawn anew in each step: an order that the graph
  /// allows by mistake shows as another result.
  static std::unique_ptr<Executor> shuffled(std::uint64_t seed, ExecutorOptions options = {});
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int n_threads() const { return static_cast<int>(workers_.size()); }

  /// Runs every instance of the schedule once, each as soon as its predecessors are done, and returns when all are.
  /// An exception of a task stops all workers and is thrown here as a TaskError, one of `Work::poll` as it is; the
  /// schedule is spent then.
  void run(Schedule& schedule, const Step& step);

  /// Between runs: has the watchdog see to it that what the host does meanwhile, with other ranks, ends in time.
  Watchdog::Watch watch(const char* activity) { return Watchdog::Watch(watchdog_, activity); }

  /// Has the state of the run printed within a tenth of a second. May be called from a signal handler.
  void request_report() noexcept { watchdog_.request_report(); }

 private:
  struct alignas(64) Worker {
    /// For the watchdog: the instance that runs, -1 if none, and since which tick.
    std::atomic<int> running{-1};
    std::atomic<std::uint64_t> since{0};
    /// Room for what `Work::poll` brings.
    std::vector<int> arrived;
  };

  void work(int worker);
  void run_shuffled();
  void run_instance(Schedule::Entry& entry, int worker);
  Schedule::Entry* steal(std::vector<OthersWalk>& others);
  bool must_poll() const;
  const std::vector<int>& poll(int worker, std::uint64_t idle_since);
  void fail(int instance, const std::string& what);
  bool stop(std::exception_ptr error);
  std::string report(double idle_time) const;

  ExecutorOptions options_;
  TickRate rate_;
  std::vector<Worker> workers_;
  std::optional<std::mt19937_64> shuffle_;

  // The run that goes on.
  Schedule* schedule_ = nullptr;
  const Step* step_ = nullptr;
  bool has_messages_ = false;
  std::uint64_t poll_interval_ = 0;
  std::mutex error_mutex_;
  std::exception_ptr error_;
  std::atomic<bool> stop_{false};
  alignas(64) std::atomic<std::uint64_t> last_poll_{0};

  // Last, so that their threads have gone before what they look at goes.
  alignas(64) Crew crew_;
  Watchdog watchdog_;
};

}  // namespace tamp::runtime
