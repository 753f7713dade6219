#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/storage/checkpoints/checkpoint.hpp"
#include "tasks/simulation.hpp"
#include "tools/bench/least_work.hpp"

namespace tamp::tools::bench
{

/// Time of a phase: nanoseconds per particle of the scene and step, and per particle that it worked on.
struct PhaseTime {
  std::string name;
  double ns = 0;
  double ns_of_own = 0;
};

/// Time that some steps took on one thread.
struct StepsTime {
  long n_steps = 0;
  /// Wall-clock time [s].
  double wall = 0;
  /// The part of it in which these steps had a core; other programs had it for the rest.
  double core_share = 0;
  /// Processor time per particle and step; of it what is no task.
  double ns = 0;
  double ns_between_tasks = 0;
  /// Most expensive first.
  std::vector<PhaseTime> phases;
  LeastWork least;
};

/// A part of a scene's time, from a fraction of it on.
struct Window {
  const char* name;
  double begin;
};

/// The state at the start of a window, and the counts until then.
struct WindowStart {
  Window window;
  runtime::FoundCheckpoint checkpoint;
  components::UpdateCounts updates;
};

/// A whole run, and where in it the windows begin.
struct WholeRun {
  StepsTime time;
  std::vector<WindowStart> starts;
};

double particles_of(const tasks::Scene& scene);

/// Runs a scene to its end on one thread; keeps its state in `folder` where windows begin.
WholeRun run_whole(const tasks::Scene& scene, std::span<const Window> windows, const std::filesystem::path& folder);

/// A simulation at the start of a window, on so many threads.
std::unique_ptr<tasks::Simulation> at_start(const tasks::Scene& scene, const WindowStart& start, int n_threads);

/// Runs `n_steps`, or to the scene's end, on so many threads; the processor time is that of all of them.
StepsTime steps_from(const tasks::Scene& scene, const WindowStart& start, long n_steps, int n_threads);

}  // namespace tamp::tools::bench
