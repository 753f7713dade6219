#pragma once

#include <filesystem>

#include "tools/scene/document.hpp"

namespace tamp::tools
{

/// The JSON of a file. Throws FileError if it cannot be read, InputError (with line and column) for text that is not
/// JSON, and for an object that has a key twice, of which JSON readers would silently take one.
Json parse_json(const std::filesystem::path& file);

}  // namespace tamp::tools
