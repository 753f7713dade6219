#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tasks/scene.hpp"

namespace tamp::tools
{

/// A scene of dimension 3 that may be replaced by an axisymmetric one about a line along `axis` through `through` [m],
/// whose entry along the axis has no meaning.
struct RoundScene {
  int axis;
  Vector<3> through;
  /// Particles of the axisymmetric scene on the same cells.
  std::size_t n_particles;
};

/// The axisymmetric scene that may replace a scene; empty where bodies are not round about one line, or anything acts
/// or moves across it. A body that fills the grid across the line counts as round: its corners are far away. Found by a
/// sample of points.
std::optional<RoundScene> round_scene(const tasks::Scene& scene);

/// Advice to run the axisymmetric scene, with its cost, if there is one.
std::optional<std::string> advice_to_turn(const tasks::Scene& scene);

}  // namespace tamp::tools
