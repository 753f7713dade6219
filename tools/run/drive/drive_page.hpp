#pragma once

#include <filesystem>
#include <string>

namespace tamp::tools
{

/// Writes the page of `--plot`: the curves of a drive and its rows, in one file that needs no other. `rows` is the CSV
/// that the drive wrote. Throws FileError where the page cannot be drawn or written; an old one is then left as it was.
void write_drive_page(const std::string& rows, const std::string& title, const std::filesystem::path& file);

}  // namespace tamp::tools
