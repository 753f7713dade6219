#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

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

/// The same for what a command writes into a folder under names of its own, which may be links. A pipe, a device or a
/// socket in its place is a FileError: nobody has asked for that.
void expect_results(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Writes a file that was asked for. Throws InputError if it is one of those that have been read since.
void write_output(const OutputFile& output, std::string_view content);

}  // namespace tamp::tools
