#include "tools/bench/tasks_metg.hpp"

#include <cmath>
#include <cstddef>

namespace tamp::tools::bench
{

std::optional<double> metg50(std::span<const TaskSample> samples)
{
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const TaskSample& below = samples[i - 1];
    const TaskSample& above = samples[i];
    if (below.efficiency() >= 0.5 || above.efficiency() < 0.5) continue;
    const double share = (0.5 - below.efficiency()) / (above.efficiency() - below.efficiency());
    return below.granularity * std::pow(above.granularity / below.granularity, share);
  }
  return std::nullopt;
}

}  // namespace tamp::tools::bench
