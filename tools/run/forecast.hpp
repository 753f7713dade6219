#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tasks/forecast/pace.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// Forecast of a run's memory, disk space and time, made before anything is stored for it.
struct Forecast {
  std::size_t n_particles = 0;
  /// At most, of all ranks [bytes].
  double memory = 0;
  /// Extra memory of the first rank for output in the background, and whether it does that; `memory` then includes it.
  double copies = 0;
  bool in_background = false;
  /// At the end of a run to the scene's end, with two checkpoints [bytes].
  double disk = 0;
  /// Nothing where it was not asked for, or no coarser grid holds the bodies.
  std::optional<tasks::Pace> pace{};
};

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
