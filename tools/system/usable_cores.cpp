#include "tools/system/usable_cores.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace tamp::tools
{

namespace
{

struct Place {
  std::array<char, 256> machine{};
  cpu_set_t cores{};
};

Place own_place()
{
  Place place;
  gethostname(place.machine.data(), place.machine.size() - 1);
  CPU_ZERO(&place.cores);
  if (sched_getaffinity(0, sizeof place.cores, &place.cores) != 0) CPU_SET(0, &place.cores);
  return place;
}

}  // namespace

UsableCores usable_cores(const runtime::Communicator& communicator)
{
  const Place own = own_place();
  cpu_set_t all = own.cores;
  int n_ranks = 0;
  for (const Place& place : communicator.gather_value(own)) {
    if (place.machine != own.machine) continue;
    CPU_OR(&all, &all, &place.cores);
    ++n_ranks;
  }
  const int n_all = CPU_COUNT(&all);
  return {n_all, std::clamp(n_all / n_ranks, 1, CPU_COUNT(&own.cores)), n_ranks};
}

}  // namespace tamp::tools
