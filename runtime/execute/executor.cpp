#include "runtime/execute/executor.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>

#include "runtime/execute/clock.hpp"
#include "runtime/execute/scheduler/backoff.hpp"
#include "runtime/execute/scheduler/ready_pool.hpp"
#include "runtime/execute/scheduler/schedule_state.hpp"
#include "runtime/execute/scheduler/thread_team.hpp"
#include "runtime/execute/scheduler/walk.hpp"
#include "runtime/execute/stall_report.hpp"
#include "runtime/reason.hpp"

namespace tamp::runtime
{

namespace
{

/// How long messages wait at most while workers are busy with short tasks [s].
constexpr double time_between_polls = 30e-6;

using Entry = ScheduleState::Entry;

/// MPI for one run, as no two threads may call it at once.
class TurnAtMpi
{
 public:
  explicit TurnAtMpi(bool is_needed) : is_needed_(is_needed)
  {
    if (is_needed_ && taken.exchange(true)) {
      throw std::logic_error("two graphs over several ranks run at once; expected one at a time");
    }
  }
  ~TurnAtMpi()
  {
    if (is_needed_) taken = false;
  }
  TurnAtMpi(const TurnAtMpi&) = delete;
  TurnAtMpi& operator=(const TurnAtMpi&) = delete;

 private:
  inline static std::atomic<bool> taken{false};
  bool is_needed_;
};

}  // namespace

/// The threads, and the run that goes on.
class Executor::Workers
{
 public:
  Workers(int n_threads, ExecutorOptions options);

  int n_threads() const { return static_cast<int>(workers_.size()); }
  void shuffle(std::uint64_t seed) { shuffle_.emplace(seed); }
  Watchdog& watchdog() { return watchdog_; }
  void run(Schedule& schedule, const Step& step);

 private:
  struct alignas(64) Worker {
    /// For the watchdog: the instance that runs, -1 if none, and the tick at which it began.
    std::atomic<int> running{-1};
    std::atomic<std::uint64_t> since{0};
    /// Room for what `Work::poll` brings, and for the ways through the other workers' lists.
    std::vector<int> arrived;
    std::vector<OthersWalk> others;
  };

  void work(int worker);
  void run_shuffled();
  void run_instance(Entry& entry, int worker);
  Entry* steal(std::vector<OthersWalk>& others);
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
  ScheduleState* schedule_ = nullptr;
  bool recording_ = true;
  bool taking_processor_time_ = false;
  const Step* step_ = nullptr;
  bool has_messages_ = false;
  std::uint64_t poll_interval_ = 0;
  std::mutex error_mutex_;
  std::exception_ptr error_;
  std::atomic<bool> stop_{false};
  alignas(64) std::atomic<std::uint64_t> last_poll_{0};

  // Last, so that their threads have gone before what they look at goes.
  alignas(64) ThreadTeam team_;
  Watchdog watchdog_;
};

Executor::Workers::Workers(int n_threads, ExecutorOptions options)
    : options_(std::move(options)),
      workers_(static_cast<std::size_t>(n_threads)),
      team_(n_threads, options_.oversubscribed, [this](int worker) { work(worker); }),
      watchdog_(
          options_.stall, [this] { return schedule_->progress(); },
          [this](double idle_time) { return report(idle_time); })
{
}

void Executor::Workers::run(Schedule& schedule, const Step& step)
{
  const TurnAtMpi turn(schedule.state_->work().has_messages());
  schedule_ = schedule.state_.get();
  recording_ = schedule.recording;
  taking_processor_time_ = schedule.taking_processor_time;
  step_ = &step;
  schedule_->begin_step();
  has_messages_ = schedule_->work().has_messages();
  if (has_messages_) poll_interval_ = static_cast<std::uint64_t>(time_between_polls / rate_.seconds_per_tick());
  {
    const Watchdog::Watch watch(watchdog_);
    if (shuffle_) {
      run_shuffled();
    } else {
      team_.run();
    }
  }
  if (stop_) {
    stop_ = false;
    std::rethrow_exception(std::exchange(error_, nullptr));
  }
}

/// Runs own instances first, others' when no own one is ready; returns when all of the step is done.
void Executor::Workers::work(int worker)
{
  const bool alone = workers_.size() == 1;
  auto& lists = schedule_->lists();
  const auto self = static_cast<std::size_t>(worker);
  if (self >= lists.size()) return;
  OwnWalk own(*schedule_, lists[self], options_.window, alone);
  std::vector<OthersWalk>& others = workers_[self].others;
  others.clear();
  for (std::size_t k = 1; k < lists.size(); ++k) {
    others.emplace_back(*schedule_, lists[(self + k) % lists.size()], options_.window);
  }
  Backoff backoff(options_.oversubscribed);
  std::uint64_t idle_since = 0;
  while (!stop_.load(std::memory_order_relaxed)) {
    Entry* entry = own.next();
    if (entry == nullptr) entry = steal(others);
    if (entry != nullptr) {
      run_instance(*entry, worker);
      backoff.reset();
      if (has_messages_ && must_poll()) poll(worker, 0);
      idle_since = 0;
      continue;
    }
    if (own.finished() && std::all_of(others.begin(), others.end(), [](const auto& o) { return o.finished(); })) break;
    if (has_messages_) {
      if (idle_since == 0) idle_since = ticks();
      poll(worker, idle_since);
    }
    backoff.wait();
  }
  workers_[self].running.store(-1, std::memory_order_relaxed);
}

Entry* Executor::Workers::steal(std::vector<OthersWalk>& others)
{
  for (OthersWalk& walk : others) {
    if (walk.finished()) continue;
    if (Entry* entry = walk.next()) return entry;
  }
  return nullptr;
}

void Executor::Workers::run_shuffled()
{
  ReadyPool pool(*schedule_);
  Backoff backoff(options_.oversubscribed);
  std::uint64_t idle_since = 0;
  while (!pool.finished() && !stop_) {
    if (has_messages_ && (pool.empty() || must_poll())) {
      if (pool.empty() && idle_since == 0) idle_since = ticks();
      for (const int instance : poll(0, idle_since)) pool.complete(instance);
    }
    if (pool.empty()) {
      backoff.wait();
      continue;
    }
    Entry& entry = pool.draw(*shuffle_);
    run_instance(entry, 0);
    pool.complete(entry.instance);
    backoff.reset();
    idle_since = 0;
  }
  workers_[0].running.store(-1, std::memory_order_relaxed);
}

void Executor::Workers::run_instance(Entry& entry, int worker)
{
  Worker& self = workers_[static_cast<std::size_t>(worker)];
  // The clock of processor time is a call of the system: outside of what the task takes.
  const std::uint64_t used_before = taking_processor_time_ ? thread_time() : 0;
  const std::uint64_t start = ticks();
  self.since.store(start, std::memory_order_relaxed);
  self.running.store(entry.instance, std::memory_order_relaxed);
  try {
    schedule_->work().run(entry.instance, *step_);
  } catch (const std::exception& error) {
    return fail(entry.instance, reason(error));
  } catch (...) {
    return fail(entry.instance, "unknown exception");
  }
  if (recording_) {
    const std::uint64_t end = ticks();
    const std::uint64_t used = taking_processor_time_ ? thread_time() - used_before : 0;
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    schedule_->record(
        entry, {start, end, static_cast<std::uint32_t>(worker), static_cast<std::uint32_t>(std::min(used, most))});
  }
  schedule_->complete(entry);
}

bool Executor::Workers::must_poll() const
{
  return ticks() - last_poll_.load(std::memory_order_relaxed) > poll_interval_;
}

/// Lets messages come and go; gives the instances of other ranks that are now done in this step.
const std::vector<int>& Executor::Workers::poll(int worker, std::uint64_t idle_since)
{
  const std::uint64_t now = ticks();
  last_poll_.store(now, std::memory_order_relaxed);
  std::vector<int>& arrived = workers_[static_cast<std::size_t>(worker)].arrived;
  arrived.clear();
  try {
    schedule_->work().poll(arrived, idle_since);
  } catch (...) {
    stop(std::current_exception());
  }
  std::erase_if(arrived, [&](int instance) {
    return !schedule_->arrive(instance, {now, now, static_cast<std::uint32_t>(worker), 0});
  });
  return arrived;
}

void Executor::Workers::fail(int instance, const std::string& what)
{
  const TaskError error(schedule_->work().describe(instance), what, std::current_exception());
  if (stop(std::make_exception_ptr(error))) schedule_->work().fail(error.what());
}

/// Stops everyone; false if somebody has done so before, whose error is then the one that counts.
bool Executor::Workers::stop(std::exception_ptr error)
{
  const std::lock_guard lock(error_mutex_);
  if (error_ != nullptr) return false;
  error_ = std::move(error);
  stop_ = true;
  return true;
}

/// The watchdog's report, while a run goes on.
std::string Executor::Workers::report(double idle_time) const
{
  const std::uint64_t now = ticks();
  std::vector<RunningInstance> running;
  for (std::size_t w = 0; w < workers_.size(); ++w) {
    const int instance = workers_[w].running.load(std::memory_order_relaxed);
    if (instance < 0 || schedule_->is_done(instance)) continue;
    const std::uint64_t since = workers_[w].since.load(std::memory_order_relaxed);
    const double time = static_cast<double>(now - since) * rate_.seconds_per_tick();
    running.push_back({instance, static_cast<int>(w), time});
  }
  return stall_report(*schedule_, running, idle_time);
}

Schedule::Schedule(Work& work, int n_workers) : state_(std::make_unique<ScheduleState>(work, n_workers)) {}

Schedule::~Schedule() = default;

const std::vector<InstanceRecord>& Schedule::records() const
{
  return state_->records();
}

Executor::Executor(int n_threads, ExecutorOptions options)
    : workers_(std::make_unique<Workers>(n_threads, std::move(options)))
{
}

std::unique_ptr<Executor> Executor::shuffled(std::uint64_t seed, ExecutorOptions options)
{
  auto executor = std::make_unique<Executor>(1, std::move(options));
  executor->workers_->shuffle(seed);
  return executor;
}

Executor::~Executor() = default;

int Executor::n_threads() const
{
  return workers_->n_threads();
}

void Executor::run(Schedule& schedule, const Step& step)
{
  workers_->run(schedule, step);
}

Watchdog::Watch Executor::watch(const char* activity)
{
  return Watchdog::Watch(workers_->watchdog(), activity);
}

void Executor::request_report() noexcept
{
  workers_->watchdog().request_report();
}

}  // namespace tamp::runtime
