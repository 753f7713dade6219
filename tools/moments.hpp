#pragma once

namespace tamp::tools
{

/// A moment that comes again and again: at every multiple of an interval of simulated time [s].
class Every
{
 public:
  explicit Every(double interval) : interval_(interval) {}

  bool due(double time)
  {
    if (time < next_) return false;
    skip_to(time);
    return true;
  }

  /// As if every moment until then, and at it, had been.
  void skip_to(double time)
  {
    // The tolerance keeps round-off in the sum of steps from making a moment come twice.
    while (next_ <= time * (1 + 1e-12)) next_ = interval_ * static_cast<double>(++n_);
  }

 private:
  double interval_;
  long n_ = 0;
  double next_ = 0;
};

}  // namespace tamp::tools
