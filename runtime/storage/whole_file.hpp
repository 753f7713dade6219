#pragma once

#include <filesystem>
#include <string>

namespace tamp::runtime
{

/// Writes a file whole or not at all: a reader sees the old content or the new, whenever it looks and however the
/// program ends. Throws FileError; the old file is then left as it was.
void write_whole_file(const std::filesystem::path& file, const std::string& content);

}  // namespace tamp::runtime
