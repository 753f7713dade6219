#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tasks/demand.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// What a run takes, said before anything is stored for it.
struct Forecast {
  std::size_t n_particles = 0;
  /// At most, of all ranks [bytes].
  double memory = 0;
  /// At the end of a run to the scene's end, with two checkpoints [bytes].
  double disk = 0;
  /// Nothing where it was not asked for, or no coarser grid holds the bodies.
  std::optional<tasks::Pace> pace{};
};

/// `calibration` is how long the scene, or a coarser one, may be run for the pace [s]; 0: no pace.
Forecast forecast(const tasks::Scene& scene, int n_ranks, double calibration);

/// Throws InputError, with a cell size that would fit, if the memory is more than there is.
void expect_room(const CheckedScene& checked, const Forecast& forecast, int n_ranks);

/// One line for a person.
std::string told(const Forecast& forecast);

}  // namespace tamp::tools
