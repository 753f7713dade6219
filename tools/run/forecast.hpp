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
  /// Largest memory of all ranks together, and the part of it that their processes have taken before they begin
  /// [bytes].
  double memory = 0;
  double at_start = 0;
  /// Extra memory of the first rank for output in the background, and whether it does that; `memory` then includes it.
  double copies = 0;
  bool in_background = false;
  /// Disk space after a run to the scene's end, with `n_checkpoints_forecast` checkpoints [bytes].
  double disk = 0;
  /// Empty where it was not asked for, or no coarser grid holds the bodies.
  std::optional<tasks::Pace> pace{};
};

/// The memory, disk space and steps that a run took, which were forecast.
struct UsedByRun {
  /// Memory on all ranks, as far as their ledgers know [bytes].
  double memory = 0;
  double disk = 0;  ///< bytes
  /// Number of steps of a run that has come to the scene's end.
  std::optional<long> n_steps{};
};

/// The largest factor by which a forecast was missed, and the quantity that missed it.
struct ForecastMiss {
  double factor = 1;
  std::string what = "memory";
};

/// Less memory or disk space than forecast is no miss. Wall time is left out, as it depends on what else the machine
/// does. A restart or a run that stops early takes less disk space.
ForecastMiss miss_of(const Forecast& forecast, const UsedByRun& taken);

/// The forecast without the pace.
Forecast forecast(const tasks::Scene& scene, int n_ranks = 1);

/// Throws InputError, with a cell size that would fit, if the ranks on this machine, `ranks_here` of them, need more
/// memory than there is.
void expect_room(const CheckedScene& checked, const Forecast& forecast, int n_ranks = 1, int ranks_here = 1);

/// Has output written in the background if there is memory for the copies that this takes. To be called for a forecast
/// for which there is room.
void add_copies(Forecast& forecast, int n_ranks = 1, int ranks_here = 1);

/// Adds the pace, from trial runs of the scene or of coarser ones.
void add_pace(const tasks::Scene& scene, const tasks::Effort& effort, Forecast& forecast);

/// The forecast in a line for people.
std::string description(const Forecast& forecast);

}  // namespace tamp::tools
