#pragma once

#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// Adds a problem for all of an axisymmetric scene that cannot be turned about the line x = 0: its grid, if it is good,
/// faces, gravity and method, which have been read.
void check_axisymmetry(const JsonReader& scene_reader, const tasks::Scene& scene, bool grid_is_good);

/// The same for its bodies, whose motion must be along that line.
void check_axisymmetric_bodies(const tasks::Scene& scene, const JsonReader& bodies);

}  // namespace tamp::tools
