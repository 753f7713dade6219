#pragma once

#include <filesystem>

#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// Where the particles of a run were at the first and the last output of its fields, for its page: a list of rasters,
/// empty where there are no fields.
///
/// In space they are those of a slab as thick as a cell: at the plane of symmetry on which what moves (or is driven, or
/// rigid) lies, or through its middle; seen along the horizontal axis along which it moves less. `scene` is the scene
/// as resolved. Throws FileError, and JSON's exceptions for a scene that is damaged.
Json scene_pictures(const std::filesystem::path& run, const Json& scene);

}  // namespace tamp::tools
