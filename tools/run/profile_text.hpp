#pragma once

#include <filesystem>
#include <string>

namespace tamp::tools
{

/// The `profile.json` of a run as a table for people.
std::string profile_text(const std::filesystem::path& file);
/// The profile as JSON. Both functions throw InputError for a file that is not there, and FileError for one that is not
/// what was written.
std::string profile_json_text(const std::filesystem::path& file);

}  // namespace tamp::tools
