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

/// Runs the scene on coarse cells, then on finer ones, for `seconds` of processor time in all, on one thread. Nothing
/// if no coarser grid holds the bodies. The cost of sand, which is highest where it flows, is known only as far as the
/// finest of these runs comes.
std::optional<Pace> pace_of(const Scene& scene, double seconds);

}  // namespace tamp::tasks
