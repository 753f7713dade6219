#pragma once

#include <optional>
#include <string>

#include "tasks/scene.hpp"
#include "tools/scene/json_reader.hpp"

namespace tamp::tools
{

/// Reads one material, tables and all. Empty if there is a problem, which the reader's document then knows.
std::optional<tasks::SceneMaterial> read_material(const std::string& name, JsonReader reader);

}  // namespace tamp::tools
