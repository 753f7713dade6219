#pragma once

namespace tamp::tools
{

/// Processor time of this thread, and of all threads of this process [s]: other work on the machine does not count.
double thread_seconds();
double process_seconds();

/// Time that one call of `work` takes on this thread [s], from enough repetitions to be measured.
template <class Work>
double seconds_of(const Work& work)
{
  constexpr double least_seconds = 2e-3;
  // Reading the clock may take longer than the work.
  for (int n = 1;; n *= 2) {
    const double start = thread_seconds();
    for (int i = 0; i < n; ++i) work();
    const double seconds = thread_seconds() - start;
    if (seconds >= least_seconds) return seconds / n;
  }
}

}  // namespace tamp::tools
