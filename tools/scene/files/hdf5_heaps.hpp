#pragma once

#include <filesystem>

namespace tamp::tools
{

/// Throws InputError for an HDF5 file with a damaged global heap, in which texts of variable length stand: one whose
/// objects do not follow each other up to its end, through which HDF5 1.10 looks for ever, or one with a text that is
/// longer than its object, for which it takes gigabytes. FileError if the file cannot be read.
void expect_sound_heaps(const std::filesystem::path& file);

}  // namespace tamp::tools
