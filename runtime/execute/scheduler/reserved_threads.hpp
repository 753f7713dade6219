#pragma once

namespace tamp::runtime
{

/// Threads that a team keeps for itself. oneTBB lends all arenas of a program threads from one pool, one for each core;
/// as long as this object lives the pool is larger by as many, so that other teams and the program's own parallel loops
/// find it as if the team were not there.
class ReservedThreads
{
 public:
  /// Throws std::runtime_error where a limit that the program has set (tbb::global_control) leaves fewer.
  explicit ReservedThreads(int n_threads);
  ~ReservedThreads();
  ReservedThreads(const ReservedThreads&) = delete;
  ReservedThreads& operator=(const ReservedThreads&) = delete;

 private:
  int n_threads_;
};

}  // namespace tamp::runtime
