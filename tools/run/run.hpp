#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "runtime/execute/executor.hpp"
#include "runtime/profile/trace_choice.hpp"
#include "runtime/ranks/communicator.hpp"
#include "tools/run/checkpointing.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// How far and how a scene is run.
struct RunOptions {
  std::filesystem::path folder;
  bool force = false;
  /// Go on from the newest checkpoint in the folder.
  bool restart = false;
  runtime::Communicator communicator{};
  /// On each rank.
  int n_threads = 1;
  runtime::ExecutorOptions executor{};
  /// Run tasks on one thread in random orders that the graph allows, see runtime::Executor::shuffled.
  std::optional<std::uint64_t> shuffle_seed{};
  /// Stop at this simulated time [s] if the scene ends later.
  double until = std::numeric_limits<double>::infinity();
  /// Stop after so many steps, counted from the scene's start.
  long max_steps = std::numeric_limits<long>::max();
  /// Stop after so many seconds of the clock, counted from the run's start, with the state kept.
  double wall_limit = std::numeric_limits<double>::infinity();
  CheckpointPolicy checkpoints{};
  /// The command with which a user goes on with a run that was stopped or has failed.
  std::string command_to_go_on{};
  /// Steps between two looks at the load of the ranks; 0: patches stay where they are.
  long balance_interval = 200;
  /// Steps that `trace.json` shows task by task; none: it is not written.
  runtime::TraceChoice traced_steps = runtime::TraceChoice::first_steps(20);
  /// No progress, no table at the end.
  bool quiet = false;
  /// A run that completes with warnings counts as one that has gone wrong.
  bool strict = false;
};

/// Runs a scene over the ranks of the communicator and fills its folder. A simulation that goes wrong leaves its last
/// good state there, and its SimulationError passes on with the step and time; a run that a signal or the wall limit
/// stops leaves a checkpoint, and throws Interrupted. Throws FileError and InputError too. Collective.
void run(const CheckedScene& scene, const RunOptions& options);

}  // namespace tamp::tools
