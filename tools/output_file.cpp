#include "tools/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/file_error.hpp"
#include "tools/errors.hpp"
#include "tools/scene/input_file.hpp"

namespace tamp::tools
{

namespace
{

namespace fs = std::filesystem;

/// The same for all names of a file that may not be there yet.
fs::path place_of(const OutputFile& output)
{
  return fs::weakly_canonical(fs::absolute(output.file));
}

void expect_writable(const OutputFile& output)
{
  std::error_code error;
  const bool is_there = fs::exists(output.file, error);
  if (fs::is_directory(output.file, error)) throw runtime::FileError(output.file.string(), std::strerror(EISDIR));
  const fs::path folder = output.file.has_parent_path() ? output.file.parent_path() : ".";
  const fs::path& place = is_there ? output.file : folder;
  if (access(place.c_str(), is_there ? W_OK : W_OK | X_OK) != 0) {
    throw runtime::FileError(output.file.string(), std::strerror(errno));
  }
  if (!is_there && !fs::is_directory(folder, error)) {
    throw runtime::FileError(output.file.string(), std::strerror(ENOTDIR));
  }
}

}  // namespace

void expect_outputs(std::initializer_list<OutputFile> outputs)
{
  for (const OutputFile& output : outputs) {
    if (output.file.empty()) continue;
    if (is_input(output.file)) {
      throw InputError(
          {output.option + " " + output.file.string(), "one of the files that are read", "expected another file"});
    }
    for (const OutputFile& other : outputs) {
      if (other.option == output.option || other.file.empty()) continue;
      if (place_of(other) != place_of(output)) continue;
      throw InputError(
          {output.option + " " + output.file.string(), "the file of " + other.option, "expected another file"});
    }
    expect_writable(output);
  }
}

}  // namespace tamp::tools
