#pragma once

#include <span>

#include "tools/run/drive/material_point.hpp"

namespace tamp::tools
{

/// Cost of the updates along a path.
struct DriveCosts {
  std::size_t n_updates;
  components::UpdateCounts counts;  ///< counts of all of them
  double ns_per_update;
};

/// Makes the updates that took a material point from each of `points` to the next once more, as a run makes those of
/// its particles: 256 at a time, in lanes. Each starts from the stress and state that the point had, so that all may go
/// side by side, and comes to what it came to in the drive. The time is the median of `n_rounds`, of this thread's
/// processor time, for the update of stress and state alone.
DriveCosts drive_costs(const tasks::MaterialModel& material, std::span<const MaterialPoint> points, int n_rounds);

}  // namespace tamp::tools
