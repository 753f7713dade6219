#pragma once

#include <cmath>

namespace tamp::tools
{

/// When a run writes something: at every multiple of an interval of simulated time [s].
class OutputTimes
{
 public:
  explicit OutputTimes(double interval) : interval_(interval) {}

  bool due(double time)
  {
    if (next_ > with_tolerance(time)) return false;
    skip_to(time);
    return true;
  }

  /// Passes over all times up to then.
  void skip_to(double time)
  {
    const double reached = with_tolerance(time);
    if (next_ > reached) return;
    n_ = std::floor(reached / interval_) + 1;
    next_ = interval_ * n_;
    // The quotient may have been rounded up or down to a whole number.
    if (interval_ * (n_ - 1) > reached) next_ = interval_ * --n_;
    if (next_ <= reached) next_ = interval_ * ++n_;
  }

 private:
  /// Round-off in the sum of steps makes no time due twice, or late.
  static double with_tolerance(double time) { return time * (1 + 1e-12); }

  double interval_;
  /// A whole number, which may be larger than an integer.
  double n_ = 0;
  double next_ = 0;
};

}  // namespace tamp::tools
