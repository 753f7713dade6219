#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

namespace tamp::tools
{

/// A file that an option asks for.
struct OutputFile {
  std::string option;
  /// Empty: not asked for.
  std::filesystem::path file;
};

/// To be asked when all inputs have been read, and before the work. Throws InputError for a file that is one of the
/// inputs or is asked for twice, and FileError for one that cannot be written.
void expect_outputs(std::initializer_list<OutputFile> outputs);

}  // namespace tamp::tools
