#pragma once

#include <optional>

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// How long a scene takes, from what a coarser one of the same bodies took.
struct Pace {
  double n_steps = 0;
  /// One core alone, all steps [s].
  double core_seconds = 0;
};

/// Runs the scene, or a coarser one if that is large, for `seconds` of processor time at most, on one thread. Nothing
/// if no coarser grid holds the bodies. The cost of sand, which is highest where it flows, is known only as far as that
/// run comes.
std::optional<Pace> pace_of(const Scene& scene, double seconds);

}  // namespace tamp::tasks
