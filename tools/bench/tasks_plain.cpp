#include <atomic>
#include <thread>

#include "tools/bench/tasks_schedulers.hpp"

namespace tamp::tools::bench
{

namespace
{

class Loop : public TaskScheduler
{
 public:
  explicit Loop(StampedTasks& tasks) : tasks_(tasks) {}

  void run(int n_runs) override
  {
    for (int i = 0; i < n_runs; ++i) {
      tasks_.begin_run();
      for (int task = 0; task < tasks_.size(); ++task) tasks_.run(task);
    }
  }

 private:
  StampedTasks& tasks_;
};

/// Threads arrive and spin until all have; after a while they let others have the core.
class SpinBarrier
{
 public:
  explicit SpinBarrier(int n_threads) : n_threads_(n_threads) {}

  void wait()
  {
    const unsigned phase = phase_.load();
    if (n_arrived_.fetch_add(1) + 1 == n_threads_) {
      n_arrived_ = 0;
      phase_ = phase + 1;
      return;
    }
    for (int n = 0; phase_.load(std::memory_order_acquire) == phase; ++n) {
      if (n > 1000) std::this_thread::yield();
    }
  }

 private:
  int n_threads_;
  alignas(64) std::atomic<int> n_arrived_{0};
  alignas(64) std::atomic<unsigned> phase_{0};
};

class BarrierTeam : public TaskScheduler
{
 public:
  BarrierTeam(StampedTasks& tasks, int n_threads) : tasks_(tasks), n_threads_(n_threads), barrier_(n_threads) {}

  void run(int n_runs) override
  {
    std::vector<std::thread> others;
    for (int thread = 1; thread < n_threads_; ++thread) {
      others.emplace_back([this, thread, n_runs] { take_part(thread, n_runs); });
    }
    take_part(0, n_runs);
    for (std::thread& other : others) other.join();
  }

 private:
  void take_part(int thread, int n_runs)
  {
    for (int i = 0; i < n_runs; ++i) {
      if (thread == 0) tasks_.begin_run();
      for (int step = 0; step < tasks_.n_steps(); ++step) {
        barrier_.wait();
        const int row = tasks_.row(step), width = tasks_.row(step + 1) - row;
        const int end = row + width * (thread + 1) / n_threads_;
        for (int task = row + width * thread / n_threads_; task < end; ++task) tasks_.run(task);
      }
      barrier_.wait();
    }
  }

  StampedTasks& tasks_;
  int n_threads_;
  SpinBarrier barrier_;
};

}  // namespace

TaskContestant loop_contestant()
{
  return {"plain loop",
          [](StampedTasks& tasks, int /*n_threads*/) -> std::unique_ptr<TaskScheduler> {
            return std::make_unique<Loop>(tasks);
          },
          true};
}

TaskContestant barrier_contestant()
{
  return {"std::thread, barrier per step", [](StampedTasks& tasks, int n_threads) -> std::unique_ptr<TaskScheduler> {
            return std::make_unique<BarrierTeam>(tasks, n_threads);
          }};
}

}  // namespace tamp::tools::bench
