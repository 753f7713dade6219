#pragma once

#include "tasks/simulation.hpp"

namespace tamp::tools::bench
{

/// Lower bounds of a particle-step's work, mean over all particles of a scene.
struct LeastWork {
  /// Each array of particles read once and written once.
  double bytes = 0;
  /// Adds, subtractions, multiplies, divisions and square roots of the method's formulas, each counted as one, as
  /// written in docs/explanation/method.md for one particle: comparisons, places in tables and a second try at anything
  /// are left out.
  double operations = 0;
};

/// Least work of a simulation that has made `n_steps` since `before`, in which substeps and modulus evaluations of its
/// sand were counted.
LeastWork least_work(const tasks::Simulation& simulation, const components::UpdateCounts& before, long n_steps);

}  // namespace tamp::tools::bench
