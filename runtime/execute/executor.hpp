#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "runtime/execute/schedule.hpp"

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

/// Runs schedules on oneTBB threads. The workers enter one arena when the executor is made and stay until it goes:
/// waking them anew for every step would cost more than many a task.
class Executor
{
 public:
  /// `n_threads` counts the caller, who works too. With one thread instances run in program order.
  explicit Executor(int n_threads);
  /// One thread, which takes any of the instances that are ready, drawn anew in each step: an order that the graph
  /// allows by mistake shows as another result.
  static std::unique_ptr<Executor> shuffled(std::uint64_t seed);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int n_threads() const { return n_threads_; }

  /// Runs every instance of the schedule once, each as soon as its predecessors are done, and returns when all are.
  /// An exception of a task stops all workers and is thrown here as a TaskError; the schedule is spent then.
  void run(Schedule& schedule, const Step& step);

 private:
  struct alignas(64) Worker {
    std::atomic<bool> busy{false};
    /// For each list of the schedule, how many of its first instances are known to be done.
    std::vector<std::size_t> cursors;
  };

  void run_shuffled();
  void serve(int worker);
  void work(int worker);
  bool run_ready(const std::vector<int>& list, std::size_t cursor, int worker);
  void run_instance(int instance, int worker);
  void fail(int instance, const std::string& what);

  int n_threads_;
  oneapi::tbb::global_control concurrency_;
  oneapi::tbb::task_arena arena_;
  std::vector<Worker> workers_;

  // What the workers are to do. Even turns are open: workers may enter; the work changes in odd ones, when none is in.
  Schedule* schedule_ = nullptr;
  const Step* step_ = nullptr;
  std::atomic<std::uint32_t> turn_{1};
  std::atomic<bool> stop_{false};
  std::atomic<bool> leave_{false};

  /// oneTBB may send a worker late, even after the executor has gone: who comes to a closed door turns back.
  struct Door {
    bool closed = false;
    std::atomic<int> n_inside{0};
  };
  std::shared_ptr<Door> door_ = std::make_shared<Door>();

  std::optional<std::mt19937_64> shuffle_;

  std::mutex error_mutex_;
  std::exception_ptr error_;
};

}  // namespace tamp::runtime
