#include "tools/run/progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tools/system/console.hpp"

namespace tamp::tools
{

Progress::Progress(bool quiet, double end, long max_steps, std::size_t n_particles)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      end_(end),
      max_steps_(max_steps),
      n_particles_(static_cast<double>(n_particles))
{
}

void Progress::show(long step, double time, double step_size)
{
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const double since = std::chrono::duration<double>(now - shown_).count();
  if (since < (terminal_ ? 0.2 : 10.0)) return;
  const double rate = n_particles_ * static_cast<double>(step - steps_shown_) / since;
  const double done = std::max(time / end_, static_cast<double>(step) / static_cast<double>(max_steps_));
  const double left = std::chrono::duration<double>(now - start_).count() * (1 - done) / done;
  write_err(fmt::format("{}step {}  time {:.4e} s  dt {:.3e} s  {:.3g} particle updates/s  {:.0f} s left{}",
                        terminal_ ? "\r\033[K" : "", step, time, step_size, rate, left, terminal_ ? "" : "\n"));
  std::fflush(stderr);
  shown_ = now;
  steps_shown_ = step;
  drawn_ = true;
}

void Progress::finish()
{
  if (drawn_ && terminal_) print_err("\n");
  drawn_ = false;
}

}  // namespace tamp::tools
