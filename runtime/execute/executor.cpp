#include "runtime/execute/executor.hpp"

#include <algorithm>
#include <utility>

#include "runtime/execute/patience.hpp"
#include "runtime/execute/ready_pool.hpp"

namespace tamp::runtime
{

namespace
{

/// How long messages wait at most while workers are busy with short tasks [s].
constexpr double time_between_polls = 30e-6;

}  // namespace

Executor::Executor(int n_threads, ExecutorOptions options)
    : options_(std::move(options)),
      workers_(static_cast<std::size_t>(n_threads)),
      crew_(n_threads, options_.oversubscribed, [this](int worker) { work(worker); }),
      watchdog_(
          options_.stall, [this] { return schedule_->progress(); },
          [this](double idle_time) { return report(idle_time); })
{
}

std::unique_ptr<Executor> Executor::shuffled(std::uint64_t seed, ExecutorOptions options)
{
  auto executor = std::make_unique<Executor>(1, std::move(options));
  executor->shuffle_.emplace(seed);
  return executor;
}

void Executor::run(Schedule& schedule, const Step& step)
{
  schedule_ = &schedule;
  step_ = &step;
  schedule.begin_step();
  has_messages_ = schedule.work().has_messages();
  if (has_messages_) poll_interval_ = static_cast<std::uint64_t>(time_between_polls / rate_.seconds_per_tick());
  {
    const Watchdog::Watch watch(watchdog_);
    if (shuffle_) {
      run_shuffled();
    } else {
      crew_.run();
    }
  }
  if (stop_) {
    stop_ = false;
    std::rethrow_exception(std::exchange(error_, nullptr));
  }
}

/// Runs own instances first, others' when no own one is ready; returns when all of the step is done.
void Executor::work(int worker)
{
  const bool alone = workers_.size() == 1;
  auto& lists = schedule_->lists();
  const auto self = static_cast<std::size_t>(worker);
  if (self >= lists.size()) return;
  OwnWalk own(*schedule_, lists[self], options_.window, alone);
  std::vector<OthersWalk> others;
  for (std::size_t k = 1; k < lists.size(); ++k) {
    others.emplace_back(*schedule_, lists[(self + k) % lists.size()], options_.window);
  }
  Patience patience(options_.oversubscribed);
  std::uint64_t idle_since = 0;
  while (!stop_.load(std::memory_order_relaxed)) {
    Schedule::Entry* entry = own.next();
    if (entry != nullptr) {
      patience.restore();
    } else if (patience.is_tried()) {
      entry = steal(others);
    }
    if (entry != nullptr) {
      run_instance(*entry, worker);
      if (has_messages_ && must_poll()) poll(worker, 0);
      idle_since = 0;
      continue;
    }
    if (own.finished() && std::all_of(others.begin(), others.end(), [](const auto& o) { return o.finished(); })) break;
    if (has_messages_) {
      if (idle_since == 0) idle_since = ticks();
      poll(worker, idle_since);
    }
    patience.wait();
  }
  workers_[self].running.store(-1, std::memory_order_relaxed);
}

Schedule::Entry* Executor::steal(std::vector<OthersWalk>& others)
{
  for (OthersWalk& walk : others) {
    if (walk.finished()) continue;
    if (Schedule::Entry* entry = walk.next()) return entry;
  }
  return nullptr;
}

void Executor::run_shuffled()
{
  ReadyPool pool(*schedule_);
  Patience patience(options_.oversubscribed);
  std::uint64_t idle_since = 0;
  while (!pool.finished() && !stop_) {
    if (has_messages_ && (pool.empty() || must_poll())) {
      if (pool.empty() && idle_since == 0) idle_since = ticks();
      for (const int instance : poll(0, idle_since)) pool.complete(instance);
    }
    if (pool.empty()) {
      patience.wait();
      continue;
    }
    Schedule::Entry& entry = pool.draw(*shuffle_);
    run_instance(entry, 0);
    pool.complete(entry.instance);
    patience.restore();
    idle_since = 0;
  }
  workers_[0].running.store(-1, std::memory_order_relaxed);
}

void Executor::run_instance(Schedule::Entry& entry, int worker)
{
  Worker& self = workers_[static_cast<std::size_t>(worker)];
  const std::uint64_t start = ticks();
  self.since.store(start, std::memory_order_relaxed);
  self.running.store(entry.instance, std::memory_order_relaxed);
  try {
    schedule_->work().run(entry.instance, *step_);
  } catch (const std::exception& error) {
    return fail(entry.instance, error.what());
  } catch (...) {
    return fail(entry.instance, "unknown exception");
  }
  if (schedule_->recording) {
    schedule_->record(entry, {start, ticks(), static_cast<std::uint32_t>(worker)});
  }
  schedule_->complete(entry);
}

bool Executor::must_poll() const
{
  return ticks() - last_poll_.load(std::memory_order_relaxed) > poll_interval_;
}

/// Lets messages come and go; gives the instances of other ranks that are now done in this step.
const std::vector<int>& Executor::poll(int worker, std::uint64_t idle_since)
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
    return !schedule_->arrive(instance, {now, now, static_cast<std::uint32_t>(worker)});
  });
  return arrived;
}

void Executor::fail(int instance, const std::string& what)
{
  const TaskError error(schedule_->work().describe(instance), what, std::current_exception());
  if (stop(std::make_exception_ptr(error))) schedule_->work().fail(error.what());
}

/// Stops everyone; false if somebody has done so before, whose error is then the one that counts.
bool Executor::stop(std::exception_ptr error)
{
  const std::lock_guard lock(error_mutex_);
  if (error_ != nullptr) return false;
  error_ = std::move(error);
  stop_ = true;
  return true;
}

/// For the watchdog, while a run goes on.
std::string Executor::report(double idle_time) const
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

}  // namespace tamp::runtime
