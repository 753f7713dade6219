#pragma once

#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/execute/scheduler/reserved_threads.hpp"

namespace tamp::runtime
{

/// oneTBB threads that stay together: they enter one arena when the team is made and wait there from job to job, as
/// waking them anew for every step would cost more than many a task.
class ThreadTeam
{
 public:
  /// `n_workers` counts the caller of `run`, who is worker 0. The job is called with the worker's number and must not
  /// throw.
  ThreadTeam(int n_workers, bool cores_are_shared, std::function<void(int)> job);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Does the job as worker 0, together with the others that come before that is over; returns when all have returned.
  void run();

 private:
  struct alignas(64) Worker {
    std::atomic<bool> busy{false};
  };

  void serve(int worker);

  ReservedThreads reserved_;
  oneapi::tbb::task_arena arena_;
  bool cores_are_shared_;
  std::function<void(int)> job_;
  std::vector<Worker> workers_;
  /// Even turns are open: workers may enter; what the job is about changes in odd ones, when none is in.
  std::atomic<std::uint32_t> turn_{1};
  std::atomic<bool> leave_{false};

  /// oneTBB may send a thread late, even after the team has gone: it looks here first whether it still has one.
  struct Membership {
    bool ended = false;
    std::atomic<int> n_threads{0};
  };
  std::shared_ptr<Membership> membership_ = std::make_shared<Membership>();
};

}  // namespace tamp::runtime
