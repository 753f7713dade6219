#include "runtime/execute/crew.hpp"

#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>

#include "runtime/execute/patience.hpp"

namespace tamp::runtime
{

namespace
{

/// Held while workers are sent out and taken by each as it comes in. All crews share it, as a worker can find it
/// without reading anything that was sent with it: so the sanitizer, too, sees that what was sent is complete.
std::mutex& entry()
{
  static std::mutex mutex;
  return mutex;
}

}  // namespace

Crew::Crew(int n_workers, bool cores_are_shared, std::function<void(int)> job)
    : concurrency_(oneapi::tbb::global_control::max_allowed_parallelism,
                   static_cast<std::size_t>(std::max(2, n_workers))),
      arena_(std::max(2, n_workers), 1),
      cores_are_shared_(cores_are_shared),
      job_(std::move(job)),
      workers_(static_cast<std::size_t>(n_workers))
{
  const std::lock_guard sending(entry());
  for (int worker = 1; worker < n_workers; ++worker) {
    arena_.enqueue([this, worker, door = door_] {
      {
        const std::lock_guard lock(entry());
        if (door->closed) return;
        ++door->n_inside;
      }
      serve(worker);
      --door->n_inside;
    });
  }
}

Crew::~Crew()
{
  {
    const std::lock_guard lock(entry());
    door_->closed = true;
  }
  leave_ = true;
  turn_ += 2;
  turn_.notify_all();
  while (door_->n_inside > 0) std::this_thread::yield();
}

void Crew::serve(int worker)
{
  std::atomic<bool>& busy = workers_[static_cast<std::size_t>(worker)].busy;
  std::uint32_t served = 0;
  Patience patience(cores_are_shared_);
  while (!leave_) {
    const std::uint32_t turn = turn_.load();
    if (turn == served || turn % 2 == 1) {
      if (patience.is_worn_out()) {
        turn_.wait(turn);
      } else {
        patience.wait();
      }
      continue;
    }
    patience.restore();
    served = turn;
    // Busy is raised before the turn is looked at again, and the caller closes the turn before it looks at busy:
    // one of the two sees the other.
    busy = true;
    if (turn_ == turn && !leave_) job_(worker);
    busy = false;
  }
}

void Crew::run()
{
  ++turn_;
  if (workers_.size() > 1) turn_.notify_all();
  job_(0);
  ++turn_;
  Patience patience(cores_are_shared_);
  for (const Worker& w : workers_) {
    while (w.busy) patience.wait();
  }
}

}  // namespace tamp::runtime
