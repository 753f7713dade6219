#pragma once

#include <filesystem>

namespace tamp::tools
{

/// Throws InputError for an HDF5 file with a global heap, in which texts of variable length stand, whose objects do not
/// follow each other up to its end: HDF5 1.10 looks through such a heap for ever. FileError if it cannot be read.
void expect_heaps_that_end(const std::filesystem::path& file);

}  // namespace tamp::tools
