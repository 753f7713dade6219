#include "tasks/monitors.hpp"

#include <algorithm>

namespace tamp::tasks
{

void SampledShare::add(const Share& share, double limit, std::int64_t n_steps, double time, const ParticlePlace& place)
{
  all.part += share.part;
  all.whole += share.whole;
  greatest = std::max(greatest, share.value());
  if (share.value() > limit) above.add(n_steps, time, place);
}

}  // namespace tamp::tasks
