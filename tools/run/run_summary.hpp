#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tasks/simulation.hpp"
#include "tools/run/forecast.hpp"
#include "tools/run/run_history.hpp"
#include "tools/run/run_output.hpp"
#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// Where the wall time of a run went [s]: before the first step, in steps, in output that they waited for, and what
/// follows the last output.
struct WallParts {
  double set_up = 0;
  double steps = 0;
  double output = 0;
  double end = 0;
};

/// How a run went, besides what its simulation and history know.
struct RunOutcome {
  /// completed, completed with warnings, unstable or interrupted, and why.
  std::string status;
  std::string reason;
  /// [s]; a step's is the median.
  double wall = 0;
  double wall_per_step = 0;
  WallParts parts;
  /// Resident memory of this rank's process before the particles were laid out [bytes].
  std::size_t resident_at_start = 0;
  /// Where a restarted run went on; -1 for one from the start.
  long restarted_at = -1;
  /// Whether fields and checkpoints were written in the background, and what output took of the time.
  bool in_background = false;
  OutputTime output;
  Forecast forecast;
  ForecastMiss missed;
  std::vector<InputFile> inputs;
  /// The keys that the scene leaves out.
  std::vector<std::string> left_out;
  std::vector<std::string> warnings;
};

/// The content of `summary.json`. Collective.
nlohmann::ordered_json run_summary(tasks::Simulation& simulation, const RunHistory& history, const RunOutcome& outcome);

/// A few lines of it for a person.
std::string summary_text(const nlohmann::ordered_json& summary);

}  // namespace tamp::tools
