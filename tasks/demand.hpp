#pragma once

#include <cstddef>
#include <optional>

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// What a scene takes, known before anything is stored for it [bytes].
struct Demand {
  std::size_t n_particles = 0;
  /// Fields and particles of all ranks.
  double fields = 0;
  /// What is gathered to write one output, and what that takes on the disk.
  double output_room = 0;
  double output_file = 0;
  double checkpoint_file = 0;
};

Demand demand_of(const Scene& scene);

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
