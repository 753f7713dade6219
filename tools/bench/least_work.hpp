#pragma once

#include "tasks/simulation.hpp"

namespace tamp::tools::bench
{

/// What a particle-step takes at the very least, the mean over all particles of a scene.
struct LeastWork {
  /// Each array of particles read once and written once.
  double bytes = 0;
  /// Adds, subtractions, multiplies, divisions and square roots of the method's formulas, each counted as one, as
  /// written in docs/method.md for one particle: comparisons, places in tables and a second try at anything are left
  /// out.
  double operations = 0;
};

/// Of a simulation that has made `n_steps` since it was at `before`: how often its sand took a substep and looked up
/// its modulus was counted in them.
LeastWork least_work(const tasks::Simulation& simulation, const components::UpdateCounts& before, long n_steps);

}  // namespace tamp::tools::bench
