#include "runtime/execute/executor.hpp"

#include <algorithm>
#include <string>
#include <thread>
#include <utility>

#include "runtime/profile/clock.hpp"

namespace tamp::runtime
{

namespace
{

/// Waits a little longer each time it is called: spinning helps on idle cores and harms on shared ones.
class Patience
{
 public:
  void wait()
  {
    ++n_waits_;
    if (n_waits_ < 200) {
#if defined(__x86_64__)
      _mm_pause();
#endif
    } else {
      std::this_thread::yield();
    }
  }
  bool worn_out() const
  {
    return n_waits_ > 2000;
  }
  void restore()
  {
    n_waits_ = 0;
  }

 private:
  int n_waits_ = 0;
};

/// Held while workers are sent out and taken by each as it comes in. All executors share it, as a worker can find it
/// without reading anything that was sent with it: so the sanitizer, too, sees that what was sent is complete.
std::mutex& entry()
{
  static std::mutex mutex;
  return mutex;
}

}  // namespace

Executor::Executor(int n_threads)
    : n_threads_(n_threads),
      concurrency_(oneapi::tbb::global_control::max_allowed_parallelism,
                   static_cast<std::size_t>(std::max(2, n_threads))),
      arena_(std::max(2, n_threads), 1),
      workers_(static_cast<std::size_t>(n_threads))
{
  const std::lock_guard sending(entry());
  for (int worker = 1; worker < n_threads; ++worker) {
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

std::unique_ptr<Executor> Executor::shuffled(std::uint64_t seed)
{
  auto executor = std::make_unique<Executor>(1);
  executor->shuffle_.emplace(seed);
  return executor;
}

Executor::~Executor()
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

void Executor::serve(int worker)
{
  std::atomic<bool>& busy = workers_[static_cast<std::size_t>(worker)].busy;
  std::uint32_t served = 0;
  Patience patience;
  while (!leave_) {
    const std::uint32_t turn = turn_.load();
    if (turn == served || turn % 2 == 1) {
      if (patience.worn_out()) {
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
    if (turn_ == turn && !leave_) work(worker);
    busy = false;
  }
}

void Executor::run(Schedule& schedule, const Step& step)
{
  schedule_ = &schedule;
  step_ = &step;
  ++schedule.epoch_;
  if (shuffle_) {
    run_shuffled();
  } else {
    for (Worker& w : workers_) w.cursors.assign(schedule.lists_.size(), 0);
    ++turn_;
    if (n_threads_ > 1) turn_.notify_all();
    work(0);
    ++turn_;
    Patience patience;
    for (const Worker& w : workers_) {
      while (w.busy) patience.wait();
    }
  }
  if (stop_) {
    stop_ = false;
    std::rethrow_exception(std::exchange(error_, nullptr));
  }
}

void Executor::run_shuffled()
{
  const auto& slots = schedule_->slots_;
  std::vector<std::vector<int>> successors(slots.size());
  std::vector<std::size_t> n_awaited(slots.size());
  std::vector<int> ready;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    n_awaited[i] = slots[i].predecessors.size();
    if (n_awaited[i] == 0) ready.push_back(static_cast<int>(i));
    for (const int p : slots[i].predecessors) successors[static_cast<std::size_t>(p)].push_back(static_cast<int>(i));
  }
  while (!ready.empty() && !stop_) {
    std::swap(ready[(*shuffle_)() % ready.size()], ready.back());
    const int instance = ready.back();
    ready.pop_back();
    run_instance(instance, 0);
    for (const int next : successors[static_cast<std::size_t>(instance)]) {
      if (--n_awaited[static_cast<std::size_t>(next)] == 0) ready.push_back(next);
    }
  }
}

/// Runs own instances first, others' when no own one is ready; returns when all of the step is done.
void Executor::work(int worker)
{
  const auto& lists = schedule_->lists_;
  const auto& slots = schedule_->slots_;
  const std::uint32_t epoch = schedule_->epoch_;
  auto& cursors = workers_[static_cast<std::size_t>(worker)].cursors;
  Patience patience;
  while (!stop_.load(std::memory_order_relaxed)) {
    bool ran = false;
    bool finished = true;
    for (std::size_t k = 0; k < lists.size() && !ran; ++k) {
      const std::size_t l = (static_cast<std::size_t>(worker) + k) % lists.size();
      std::size_t& cursor = cursors[l];
      while (cursor < lists[l].size() &&
             slots[static_cast<std::size_t>(lists[l][cursor])].done.load(std::memory_order_acquire) == epoch) {
        ++cursor;
      }
      finished &= cursor == lists[l].size();
      ran = run_ready(lists[l], cursor, worker);
    }
    if (ran) {
      patience.restore();
    } else if (finished) {
      return;
    } else {
      patience.wait();
    }
  }
}

/// Claims and runs the first ready instance of a list, looking no further than a window past `cursor`.
bool Executor::run_ready(const std::vector<int>& list, std::size_t cursor, int worker)
{
  constexpr std::size_t window = 64;
  const std::uint32_t epoch = schedule_->epoch_;
  auto& slots = schedule_->slots_;
  const auto is_done = [&](int i) {
    return slots[static_cast<std::size_t>(i)].done.load(std::memory_order_acquire) == epoch;
  };
  const std::size_t end = std::min(list.size(), cursor + window);
  for (std::size_t k = cursor; k < end; ++k) {
    Schedule::Slot& slot = slots[static_cast<std::size_t>(list[k])];
    std::uint32_t claimed = slot.claimed.load(std::memory_order_relaxed);
    if (claimed == epoch || !std::all_of(slot.predecessors.begin(), slot.predecessors.end(), is_done)) continue;
    if (!slot.claimed.compare_exchange_strong(claimed, epoch, std::memory_order_relaxed)) continue;
    run_instance(list[k], worker);
    return true;
  }
  return false;
}

void Executor::run_instance(int instance, int worker)
{
  const auto i = static_cast<std::size_t>(instance);
  const std::uint64_t start = schedule_->recording ? ticks() : 0;
  try {
    schedule_->work_.run(instance, *step_);
  } catch (const std::exception& error) {
    return fail(instance, error.what());
  } catch (...) {
    return fail(instance, "unknown exception");
  }
  if (schedule_->recording) schedule_->records_[i] = {start, ticks(), static_cast<std::uint32_t>(worker)};
  schedule_->slots_[i].done.store(schedule_->epoch_, std::memory_order_release);
}

/// Keeps the first error, with where it happened, and stops everyone.
void Executor::fail(int instance, const std::string& what)
{
  const std::string where = schedule_->work_.describe(instance);
  const std::lock_guard lock(error_mutex_);
  if (error_ == nullptr) error_ = std::make_exception_ptr(TaskError(where, what, std::current_exception()));
  stop_ = true;
}

}  // namespace tamp::runtime
