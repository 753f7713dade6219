#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Benchmarks, each of which measures what it compares in one run, interleaved, so that a noisy machine disturbs both
/// sides alike.
namespace tamp::tools::bench
{

/// The result as it goes into the file of `--json`, and the table for a person.
struct Result {
  nlohmann::ordered_json json;
  std::string text;
};

struct WindowOptions {
  std::filesystem::path scene;
  /// Steps of a window; 0: a twentieth of the run, or two seconds' worth if that is less.
  long n_steps = 0;
  int n_rounds = 5;
};

/// Cost of a particle-step of a scene on one thread, over the whole run and in windows at its start, its middle and
/// its end, phase by phase; beside it what memory and arithmetic need at least at the speed that this machine showed in
/// the same run. Windows start from checkpoints of the whole run, and are run on two threads too. Besides, what
/// recording costs, and how many bytes a particle takes. Throws SimulationError, FileError and InputError.
Result windows(const std::string& name, const WindowOptions& options);

/// Time for K of one state (rate form) and for p and K (state form), in a batch of 4096 spread over the data, in lanes
/// and one by one: Table, SVR, MLP, and SVR and MLP compiled, each against its definition evaluated plainly, and
/// against its multiplications and additions at the processor's best. The plain network gives K alone.
Result moduli(const std::filesystem::path& material);

struct PeerOptions {
  int n_rounds = 5;
  int n_steps = 50;
  /// About, in a block that is a cube; 0: 40,000 in the plane and 64,000 in space.
  long n_particles = 0;
};

/// A block of soil on a floor by quadratic splines, in the plane and in space, with FLIP and APIC, in turns with a
/// plain MLS-MPM that does no more than it must: the same particles and steps on one thread, in processor time.
Result peers(const PeerOptions& options);

struct GainOptions {
  std::filesystem::path scene;
  /// Each is slower in a run of its own. Without any: the dearest that is on the longest chain of most steps, and the
  /// dearest that hardly ever is.
  std::vector<std::string> tasks;
  int n_rounds = 15;
  long n_steps = 400;
  int n_threads = 2;
};

/// Whether what a profile says of a faster task comes true: a task is made one and a half times as long,
/// and the step that replay forecasts from a run without that compared with the one measured, in turns. Throws
/// InputError for a task that the scene's step has not.
Result gains(const GainOptions& options);

struct TaskOptions {
  int n_rounds = 15;
  /// After this no further round begins: where others use the cores, schedulers that spin may take very long.
  std::chrono::seconds patience{50};
  /// On one rank.
  std::vector<int> n_threads{1, 2};
  /// Between ranks; a multiple of 8.
  int message_bytes = 1024;
};

/// Cost of a task with TAMP's executor and with others, after Task Bench (Slaughter et al., SC 2020): overhead per
/// task with an empty body, and METG(50 %), the granularity at which half of the time is work. On several ranks it is
/// the exchange between them that is measured, with one thread each; collective.
Result tasks(const TaskOptions& options);

}  // namespace tamp::tools::bench
