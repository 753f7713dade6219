#pragma once

#include <optional>
#include <string>

#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// Reads one body of a scene whose grid, particles per axis and materials are known, and counts its particles.
/// Empty if there is a problem, which the reader's document then knows. Where the grid is not good, nothing is said of
/// how the body lies in it.
std::optional<tasks::SceneBody> read_body(const std::string& name, JsonReader reader, const tasks::Scene& scene,
                                          const std::vector<std::string>& material_names, bool grid_is_good);

}  // namespace tamp::tools
