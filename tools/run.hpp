#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// How far and how a scene is run.
struct RunOptions {
  std::filesystem::path folder;
  bool force = false;
  int n_threads = 1;
  /// Run tasks on one thread in random orders that the graph allows, see runtime::Executor::shuffled.
  std::optional<std::uint64_t> shuffle_seed{};
  /// Stop at this simulated time [s] if the scene ends later.
  double until = std::numeric_limits<double>::infinity();
  /// Stop after so many steps.
  long max_steps = std::numeric_limits<long>::max();
  /// No progress, no table at the end.
  bool quiet = false;
};

/// Runs a scene and fills its folder. A simulation that goes wrong leaves its last good state there, and its
/// SimulationError passes on with the step and time. Throws FileError and InputError too.
void run(const CheckedScene& scene, const RunOptions& options);

}  // namespace tamp::tools
