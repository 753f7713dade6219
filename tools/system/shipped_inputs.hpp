#pragma once

#include <filesystem>
#include <vector>

namespace tamp::tools
{

/// Where shipped inputs are looked for, whether or not there are such folders: `inputs` of the current folder, of the
/// source tree that the program was built in, and of the place it was installed to.
std::vector<std::filesystem::path> input_folders();

/// A file of the shipped inputs, such as "punch/table.json", in the first of these folders that has it. Throws
/// FileError where none has.
std::filesystem::path shipped_input(const std::filesystem::path& file);

/// The folder of the Python tools, as the interpreter takes it: of the source tree that the program was built in, or of
/// the place it was installed to. Throws FileError where it is in neither.
std::filesystem::path shipped_python_tools();

}  // namespace tamp::tools
