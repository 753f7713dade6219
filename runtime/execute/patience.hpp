#pragma once

#include <bit>
#include <chrono>
#include <thread>

#if defined(__x86_64__)
#  include <x86intrin.h>
#endif

namespace tamp::runtime
{

/// Waits a little longer each time it is called: it spins, then yields, then sleeps. Spinning helps on cores of one's
/// own; on shared ones it holds the core that the awaited thread needs, so there a waiter sleeps soon.
class Patience
{
 public:
  explicit Patience(bool cores_are_shared) : cores_are_shared_(cores_are_shared) {}

  void wait()
  {
    ++n_waits_;
    if (n_waits_ < n_spins) {
#if defined(__x86_64__)
      _mm_pause();
#endif
    } else if (is_worn_out()) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    } else {
      std::this_thread::yield();
    }
  }
  /// Whether to look for work elsewhere: not at once and ever less often, as looking at what others are about to do
  /// slows them down.
  bool is_tried() const
  {
    return n_waits_ >= 8 && (n_waits_ >= n_spins || std::has_single_bit(n_waits_));
  }
  /// Whether it has waited long enough to block until it is woken.
  bool is_worn_out() const
  {
    return n_waits_ > n_spins + (cores_are_shared_ ? 20 : 2000);
  }
  void restore()
  {
    n_waits_ = 0;
  }

 private:
  static constexpr unsigned n_spins = 200;

  bool cores_are_shared_;
  unsigned n_waits_ = 0;
};

}  // namespace tamp::runtime
