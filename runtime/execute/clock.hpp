#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

#if defined(__x86_64__)
#  include <x86intrin.h>
#endif

namespace tamp::runtime
{

/// A counter that is cheap to read: the processor's time stamp where there is one, else nanoseconds.
inline std::uint64_t ticks()
{
#if defined(__x86_64__)
  return __rdtsc();
#else
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// Processor time of the calling thread [ns]. A call takes a fifth of a microsecond: not for every task of every step.
inline std::uint64_t thread_time()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(time.tv_nsec);
}

/// Turns ticks into seconds by comparing the counter with the steady clock since construction.
class TickRate
{
 public:
  TickRate() : first_ticks_(ticks()), first_time_(std::chrono::steady_clock::now()) {}

  double seconds_per_tick() const
  {
    const std::uint64_t n = ticks() - first_ticks_;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - first_time_;
    return n == 0 ? 0 : passed.count() / static_cast<double>(n);
  }

 private:
  std::uint64_t first_ticks_;
  std::chrono::steady_clock::time_point first_time_;
};

}  // namespace tamp::runtime
