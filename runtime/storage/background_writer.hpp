#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace tamp::runtime
{

/// Writes files on a thread of its own while the program goes on, one job after another in the order in which they were
/// given. A job has all its data in itself and makes no calls of MPI; as HDF5 lets one thread in at a time, no other
/// thread uses it meanwhile.
///
/// An exception of a job is thrown by the next call here; the jobs after it are dropped.
class BackgroundWriter
{
 public:
  using Job = std::function<void()>;

  /// Throws std::system_error if there can be no thread.
  BackgroundWriter();
  /// Waits for all jobs; what they throw is lost.
  ~BackgroundWriter();
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;

  /// Waits until no job is left. Whoever copies data for a job waits first, and so there is never more than one copy.
  void wait();
  /// Leaves a job to be done.
  void add(Job job);
  /// Whether a job has thrown. Costs next to nothing.
  bool has_failed() const;
  /// How long callers have waited here so far [s].
  double waited() const { return waited_; }

 private:
  void work();
  void throw_failure();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  /// The first is being done.
  std::deque<Job> jobs_;
  std::exception_ptr failure_;
  bool failed_ = false;
  bool leave_ = false;
  double waited_ = 0;
  std::thread thread_;
};

}  // namespace tamp::runtime
