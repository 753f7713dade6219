#pragma once

#include <optional>

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// How long a scene takes, from what it took on coarser cells.
struct Pace {
  double n_steps = 0;
  /// One core alone, all steps [s].
  double core_seconds = 0;
};

/// What a forecast may cost at most, on one thread.
struct Effort {
  /// Processor time [s].
  double seconds = 0.7;
  /// Part of what the run itself is expected to take.
  double part_of_run = 1;
};

/// Runs the scene on coarse cells, then on finer ones. Nothing if no coarser grid holds the bodies. The cost of sand,
/// which is highest where it flows, is known only as far as the finest of these runs comes.
std::optional<Pace> pace_of(const Scene& scene, const Effort& effort);

}  // namespace tamp::tasks
