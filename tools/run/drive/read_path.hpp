#pragma once

#include <filesystem>

#include "tools/run/drive/mixed_path.hpp"

namespace tamp::tools
{

/// Reads a path in either of two formats, distinguished by the first line that is no comment (#):
///  - CSV: a line with the names of the columns in any order, then rows of numbers. They are `time` [s] and, for each
///    axis, either F11, F22, F33 or the Cauchy stress S11, S22, S33 [Pa, tension positive]; besides, F12, F13, F21,
///    F23, F31, F32, without which they are 0, and S12, S13, S23, to which F12, F13, F23 give way;
///  - the published prescribed deformation: rows of 14 numbers separated by blanks, which are the time, F row by row,
///    and the angle in degrees and the axis of a superposed rotation.
/// Throws InputError with file and line for anything else and for what DeformationPath or MixedPath refuses, FileError
/// for a file that cannot be read.
LoadPath read_path(const std::filesystem::path& file);

}  // namespace tamp::tools
