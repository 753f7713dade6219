#include "tools/system/processor_time.hpp"

#include <ctime>

namespace tamp::tools
{

namespace
{

double seconds_on(clockid_t clock)
{
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double thread_seconds()
{
  return seconds_on(CLOCK_THREAD_CPUTIME_ID);
}

double process_seconds()
{
  return seconds_on(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace tamp::tools
