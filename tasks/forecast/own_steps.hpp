#pragma once

#include "tasks/simulation.hpp"

namespace tamp::tasks
{

/// Counts the steps that a scene takes on its own cells, while a trial of it runs on cells `factor` times as large.
/// Beside the cells that waves cross in a step, the two differ in this:
///  - the longest step of the scene is as long on any cells;
///  - sand that is thrown up is opened the further the smaller the cells are, see `loosest_bound`.
class OwnSteps
{
 public:
  /// The scene must outlive it.
  OwnSteps(const Scene& scene, int factor);

  /// To be called before each step of the trial.
  void before(Simulation& trial);
  /// To be called after each step of the trial.
  void after(const Simulation& trial);

  double count() const { return count_; }

 private:
  double loosest_bound(Simulation& trial) const;

  const Scene& scene_;
  int factor_;
  double bound_ = 0;    ///< of the next step, on the scene's own cells, before the multiplier [s]
  double loosest_ = 0;  ///< the part of it that the loosest sand has [s]
  double count_ = 0;
};

}  // namespace tamp::tasks
