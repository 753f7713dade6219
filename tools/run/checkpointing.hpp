#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runtime/storage/checkpoints/checkpoint.hpp"
#include "tools/run/output_times.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// Times at which a run keeps its state, besides when a signal stops it: at intervals of steps, of simulated and of
/// wall time.
struct CheckpointPolicy {
  /// Interval in steps; 0: never.
  long steps = 0;
  /// [s]
  double simulated = std::numeric_limits<double>::infinity();
  double wall = 600;
  /// Number of checkpoints that are kept, the newest ones.
  int keep = 2;
};

/// Tells when a checkpoint is due.
class CheckpointClock
{
 public:
  explicit CheckpointClock(const CheckpointPolicy& policy);

  /// Passes over checkpoints that were due until then, which a restarted run has.
  void skip_to(double time) { simulated_.skip_to(time); }
  /// Whether one is due by steps or simulated time; the same on all ranks.
  bool due(long step, double time);
  /// Whether one is due by wall time: one rank asks, all write.
  bool wall_time_over() const;
  void written() { last_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;

  CheckpointPolicy policy_;
  OutputTimes simulated_;
  Clock::time_point last_ = Clock::now();
};

/// Parts of a scene that must be the same for a restart, as JSON: a hash of all but its title, its times, its limits
/// and its output, and one of each file that it reads.
std::string fingerprint(const CheckedScene& scene);

/// The step of the newest checkpoint of a run by its name, if there is one: whether it is whole,
/// `checkpoint_to_restart` finds out.
std::optional<std::int64_t> newest_step(const std::filesystem::path& run_folder);

/// The newest whole checkpoint of a run. Says on stderr which were refused, and renames them. Throws InputError if
/// there is none, or if it is of another scene or other data, and then names what differs. Collective.
runtime::FoundCheckpoint checkpoint_to_restart(const std::filesystem::path& run_folder, const CheckedScene& scene,
                                               const runtime::Communicator& communicator);

}  // namespace tamp::tools
