#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tasks/forecast/pace.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// How many checkpoints the forecast of disk space has room for.
constexpr int n_checkpoints_forecast = 2;

/// Forecast of a run's memory, disk space and time, made before anything is stored for it.
struct Forecast {
  std::size_t n_particles = 0;
  /// At most, of all ranks; and of that, what their processes have taken before they begin [bytes].
  double memory = 0;
  double at_start = 0;
  /// Extra memory of the first rank for output in the background, and whether it does that; `memory` then includes it.
  double copies = 0;
  bool in_background = false;
  /// At the end of a run to the scene's end, with `n_checkpoints_forecast` checkpoints [bytes].
  double disk = 0;
  /// Nothing where it was not asked for, or no coarser grid holds the bodies.
  std::optional<tasks::Pace> pace{};
};

/// What a run took of what was forecast.
struct UsedByRun {
  /// On all ranks, as far as their ledgers know [bytes].
  double memory = 0;
  double disk = 0;  ///< bytes
  /// Of a run that has come to the scene's end.
  std::optional<long> n_steps{};
};

/// The largest factor by which a forecast was missed, and of what.
struct ForecastMiss {
  double factor = 1;
  std::string what = "memory";
};

/// Less memory or disk space than forecast is no miss. Wall time is left out, as it depends on what else the machine
/// does. A restart or a run that stops early takes less disk space.
ForecastMiss miss_of(const Forecast& forecast, const UsedByRun& taken);

/// All but the pace.
Forecast forecast(const tasks::Scene& scene, int n_ranks = 1);

/// Throws InputError, with a cell size that would fit, if the memory of the `ranks_here`, those on this machine, is
/// more than there is.
void expect_room(const CheckedScene& checked, const Forecast& forecast, int n_ranks = 1, int ranks_here = 1);

/// Decides that output is written in the background if there is memory for the copies that this takes. Of a forecast
/// for which there is room.
void add_copies(Forecast& forecast, int n_ranks = 1, int ranks_here = 1);

/// Tries how fast the scene, or a coarser one, goes.
void add_pace(const tasks::Scene& scene, const tasks::Effort& effort, Forecast& forecast);

/// One line for a person.
std::string description(const Forecast& forecast);

}  // namespace tamp::tools
