#pragma once

#include <filesystem>

namespace tamp::tools
{

/// A file of the shipped inputs, such as "punch/table.json": in `inputs` of the current folder, of the source tree that
/// the program was built in, or of the place it was installed to. Throws FileError where it is in none.
std::filesystem::path shipped_input(const std::filesystem::path& file);

/// The folder of the Python tools, as the interpreter takes it: of the source tree that the program was built in, or of
/// the place it was installed to. Throws FileError where it is in neither.
std::filesystem::path shipped_python_tools();

}  // namespace tamp::tools
