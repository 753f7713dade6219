#pragma once

#include <filesystem>

#include "tools/run/drive/path.hpp"

namespace tamp::tools
{

/// Reads a path in either of two formats, distinguished by the first line that is no comment (#):
///  - CSV: a line with the names time,F11,F12,F13,F21,...,F33 in any order, then rows of numbers;
///  - the published prescribed deformation: rows of 14 numbers separated by blanks, which are the time, F row by row,
///    and the angle in degrees and the axis of a superposed rotation.
/// Throws InputError with file and line for anything else and for what DeformationPath refuses, FileError for a file
/// that cannot be read.
DeformationPath read_path(const std::filesystem::path& file);

}  // namespace tamp::tools
