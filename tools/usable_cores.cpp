#include "tools/usable_cores.hpp"

#include <sched.h>

namespace tamp::tools
{

int usable_cores()
{
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace tamp::tools
