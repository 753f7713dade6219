#pragma once

#include <cstddef>

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// Memory and disk space for a scene, known before anything is stored for it [bytes].
struct Demand {
  std::size_t n_particles = 0;
  /// Fields and particles of all ranks.
  double fields = 0;
  /// Tasks with all that is known of them, and their messages.
  double graph = 0;
  /// Memory gathered to write one output, and its room on the disk.
  double output_room = 0;
  double output_file = 0;
  /// A copy of the state, in memory as on the disk.
  double checkpoint_file = 0;
};

Demand demand_of(const Scene& scene, int n_ranks = 1);

}  // namespace tamp::tasks
