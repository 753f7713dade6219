#pragma once

#include <chrono>
#include <thread>

#if defined(__x86_64__)
#  include <x86intrin.h>
#endif

namespace tamp::runtime
{

/// Waits: it spins, on cores of one's own for a millisecond, on shared ones for some microseconds, as it holds the core
/// that the awaited thread needs; then it sleeps. It never yields: where other programs keep the cores busy a thread
/// that has slept is back at once, and one that has yielded only after milliseconds.
class Backoff
{
 public:
  explicit Backoff(bool cores_are_shared) : cores_are_shared_(cores_are_shared) {}

  void wait()
  {
    ++n_waits_;
    if (n_waits_ < n_spins) return spin();
    if (!cores_are_shared_) {
      const auto now = std::chrono::steady_clock::now();
      if (n_waits_ == n_spins) spinning_since_ = now;
      if (now - spinning_since_ < std::chrono::milliseconds(1)) return spin();
    }
    has_slept_ = true;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  /// Whether it has waited long enough to block until it is woken.
  bool should_block() const { return has_slept_; }
  void reset()
  {
    n_waits_ = 0;
    has_slept_ = false;
  }

 private:
  static void spin()
  {
#if defined(__x86_64__)
    _mm_pause();
#endif
  }

  static constexpr unsigned n_spins = 200;

  bool cores_are_shared_;
  std::chrono::steady_clock::time_point spinning_since_;
  unsigned n_waits_ = 0;
  bool has_slept_ = false;
};

}  // namespace tamp::runtime
