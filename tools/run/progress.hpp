#pragma once

#include <chrono>
#include <cstddef>

namespace tamp::tools
{

/// The progress line of a run on stderr: redrawn in place on a terminal, else a new line now and then.
class Progress
{
 public:
  /// The run ends at `end` [s] of simulated time or after `max_steps`, whichever is first.
  Progress(bool quiet, double end, long max_steps, std::size_t n_particles);

  void show(long step, double time, double step_size);
  /// Ends the line that is being redrawn.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_;
  bool terminal_;
  double end_;
  long max_steps_;
  double n_particles_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
  long steps_shown_ = 0;
  bool drawn_ = false;
};

}  // namespace tamp::tools
