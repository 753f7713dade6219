#pragma once

#include "runtime/data/label.hpp"

namespace tamp::runtime
{

/// The verdict of a step on itself, once it has been computed: whether it refuses to take place.
struct StepVerdict {
  bool refused = false;
};

/// Computed by a task over ranks, from what all of them know alike. A step that refuses itself leaves the state before
/// it as it was: the migration that waits for the verdict moves no particle, and Engine::advance says so.
inline const GlobalLabel<StepVerdict, "step verdict"> step_verdict;

}  // namespace tamp::runtime
