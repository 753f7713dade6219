#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/run/forecast.hpp"
#include "tools/run/run_history.hpp"

namespace tamp::tools
{

/// The finding of a run on one thing that can go wrong.
struct Monitor {
  /// Name of its limit in the scene.
  std::string name;
  /// How often it was seen; empty for sums.
  std::optional<double> count;
  /// The share, or factor, that is compared with the limit.
  double share = 0;
  double limit = 0;
  tasks::Occurrences first;
  /// Meaning and remedy of a share beyond the limit, in words.
  std::string words;
  /// Whether the share is a factor, of which 1 is the best, and not a part.
  bool is_factor = false;

  bool warns() const { return share > limit; }
};

/// All monitors of a run so far, the worst first: by their shares over their limits.
std::vector<Monitor> monitors_of(const tasks::Simulation& simulation, const RunHistory& history,
                                 const ForecastMiss& missed);

/// The warning in a line for people.
std::string warning_of(const Monitor& monitor, const tasks::Scene& scene);

nlohmann::ordered_json to_json(const Monitor& monitor, const tasks::Scene& scene);

}  // namespace tamp::tools
