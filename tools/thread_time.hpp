#pragma once

namespace tamp::tools
{

/// Processor time of this thread [s]: what others do on the machine does not count.
double thread_seconds();

/// What `work` takes of this thread [s], done again and again for long enough to be measured.
template <class Work>
double seconds_of(const Work& work)
{
  constexpr double least_seconds = 2e-3;
  const double start = thread_seconds();
  double seconds = 0;
  int n = 0;
  while (seconds < least_seconds) {
    work();
    ++n;
    seconds = thread_seconds() - start;
  }
  return seconds / n;
}

}  // namespace tamp::tools
