#include "runtime/storage/background_writer.hpp"

#include <chrono>
#include <utility>

namespace tamp::runtime
{

BackgroundWriter::BackgroundWriter() : thread_([this] { work(); }) {}

BackgroundWriter::~BackgroundWriter()
{
  {
    const std::lock_guard lock(mutex_);
    leave_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void BackgroundWriter::wait()
{
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.empty(); });
  waited_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  throw_failure();
}

void BackgroundWriter::add(Job job)
{
  {
    const std::lock_guard lock(mutex_);
    throw_failure();
    jobs_.push_back(std::move(job));
  }
  changed_.notify_all();
}

bool BackgroundWriter::has_failed() const
{
  const std::lock_guard lock(mutex_);
  return failed_;
}

/// Throws a failure once: whoever has heard of it may wait for the rest.
void BackgroundWriter::throw_failure()
{
  if (failure_ != nullptr) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void BackgroundWriter::work()
{
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return leave_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    Job job = std::move(jobs_.front());
    lock.unlock();
    std::exception_ptr failure;
    try {
      job();
    } catch (...) {
      failure = std::current_exception();
    }
    job = nullptr;  // its data go before anyone hears that it is done
    lock.lock();
    jobs_.pop_front();
    if (failure != nullptr) {
      failure_ = std::move(failure);
      failed_ = true;
      jobs_.clear();
    }
    changed_.notify_all();
  }
}

}  // namespace tamp::runtime
