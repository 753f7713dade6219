#include "runtime/execute/scheduler/thread_team.hpp"

#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>

#include "runtime/execute/scheduler/backoff.hpp"

namespace tamp::runtime
{

namespace
{

/// Held while workers are sent out and taken by each as it joins. All teams share it, as a worker can find it without
/// reading anything that was sent with it: so the sanitizer, too, sees that what was sent is complete.
std::mutex& joining()
{
  static std::mutex mutex;
  return mutex;
}

}  // namespace

ThreadTeam::ThreadTeam(int n_workers, bool cores_are_shared, std::function<void(int)> job)
    : reserved_(n_workers - 1),
      arena_(std::max(2, n_workers), 1),
      cores_are_shared_(cores_are_shared),
      job_(std::move(job)),
      workers_(static_cast<std::size_t>(n_workers))
{
  const std::lock_guard sending(joining());
  for (int worker = 1; worker < n_workers; ++worker) {
    arena_.enqueue([this, worker, membership = membership_] {
      {
        const std::lock_guard lock(joining());
        if (membership->ended) return;
        ++membership->n_threads;
      }
      serve(worker);
      --membership->n_threads;
    });
  }
}

ThreadTeam::~ThreadTeam()
{
  {
    const std::lock_guard lock(joining());
    membership_->ended = true;
  }
  leave_ = true;
  turn_ += 2;
  turn_.notify_all();
  while (membership_->n_threads > 0) std::this_thread::yield();
}

void ThreadTeam::serve(int worker)
{
  std::atomic<bool>& busy = workers_[static_cast<std::size_t>(worker)].busy;
  std::uint32_t served = 0;
  Backoff backoff(cores_are_shared_);
  while (!leave_) {
    const std::uint32_t turn = turn_.load();
    if (turn == served || turn % 2 == 1) {
      if (backoff.should_block()) {
        turn_.wait(turn);
      } else {
        backoff.wait();
      }
      continue;
    }
    backoff.reset();
    served = turn;
    // Busy is raised before the turn is looked at again, and the caller closes the turn before it looks at busy:
    // one of the two sees the other.
    busy = true;
    if (turn_ == turn && !leave_) job_(worker);
    busy = false;
  }
}

void ThreadTeam::run()
{
  ++turn_;
  if (workers_.size() > 1) turn_.notify_all();
  job_(0);
  ++turn_;
  Backoff backoff(cores_are_shared_);
  for (const Worker& w : workers_) {
    while (w.busy) backoff.wait();
  }
}

}  // namespace tamp::runtime
