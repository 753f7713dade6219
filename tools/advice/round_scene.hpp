#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tasks/scene.hpp"

namespace tamp::tools
{

/// A scene of dimension 3 that an axisymmetric one may stand for: about a line along `axis` through `through` [m], of
/// which the entry along the axis says nothing.
struct RoundScene {
  int axis;
  Vector<3> through;
  /// Particles of the axisymmetric scene on the same cells.
  std::size_t n_particles;
};

/// Empty where bodies are not round about one line, or anything acts or moves across it. A body that fills the grid
/// across the line counts as round: its corners are far away. Found by a sample of points.
std::optional<RoundScene> round_scene(const tasks::Scene& scene);

/// What the axisymmetric scene would take, if there is one.
std::optional<std::string> advice_to_turn(const tasks::Scene& scene);

}  // namespace tamp::tools
