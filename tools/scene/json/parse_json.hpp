#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tools/scene/json/document.hpp"

namespace tamp::tools
{

/// More than any file needs, and little enough for those who follow JSON level by level.
inline constexpr int most_json_levels = 100;

/// The JSON of a file, which may have comments as C++ has them: people write scenes. Throws FileError if it cannot be
/// read, InputError (with line and column) for text that is not JSON, for an object that has a key twice, of which JSON
/// readers would silently take one, and for more levels.
Json parse_json(const std::filesystem::path& file);

/// The text with what is no UTF-8, which JSON cannot hold, replaced by a mark.
std::string utf8(const std::string& text);

/// The JSON of a text without comments, or nothing for text that is not JSON or has more levels.
std::optional<Json> json_of(const std::string& text);

}  // namespace tamp::tools
