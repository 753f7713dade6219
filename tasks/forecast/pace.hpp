#pragma once

#include <optional>

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// How long a scene takes, from what it took on coarser cells.
struct Pace {
  double n_steps = 0;
  /// Time that all steps take on a single core [s].
  double core_seconds = 0;
};

/// The most that a forecast may cost, on one thread.
struct Effort {
  /// Processor time [s].
  double seconds = 0.7;
  /// Largest part of the time that the run itself is expected to take.
  double part_of_run = 1;
};

/// Runs the scene on coarse cells, then on finer ones. Empty if no coarser grid holds the bodies. The cost of sand,
/// which is highest where it flows, is known only for the part of the run that the finest of these runs completes.
std::optional<Pace> pace_of(const Scene& scene, const Effort& effort);

}  // namespace tamp::tasks
