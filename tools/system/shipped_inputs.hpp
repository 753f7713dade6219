#pragma once

#include <filesystem>

namespace tamp::tools
{

/// A file of the shipped inputs, such as "punch/table.json": in `inputs` of the current folder, of the source tree that
/// the program was built in, or of the place it was installed to. Throws FileError where it is in none.
std::filesystem::path shipped_input(const std::filesystem::path& file);

/// A script that the program calls, such as "draw_compare.py": of the source tree that the program was built in, or of
/// the place it was installed to. Throws FileError where it is in neither.
std::filesystem::path shipped_script(const std::filesystem::path& file);

}  // namespace tamp::tools
