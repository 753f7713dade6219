#pragma once

#include <filesystem>
#include <string>

namespace tamp::runtime
{

/// Writes a file whole or not at all: a reader sees the old content or the new, whenever it looks and however the
/// program ends. Throws FileError; the old file is then left as it was.
void write_whole_file(const std::filesystem::path& file, const std::string& content);

/// FILE.damaged, or the first of FILE.damaged.2, FILE.damaged.3 ... that is not there yet.
std::filesystem::path name_aside(const std::filesystem::path& file);

/// Gives a finished file the name under which it is looked for, once it is on the disk and not only on its way there:
/// whoever finds it finds all of it, even after the power has failed. Throws FileError.
void put_in_place(const std::filesystem::path& part, const std::filesystem::path& file);

}  // namespace tamp::runtime
