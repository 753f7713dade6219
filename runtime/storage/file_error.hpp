#pragma once

#include <stdexcept>
#include <string>

namespace tamp::runtime
{

/// A file that could not be read or written as it should: missing, forbidden, damaged, or no room left on the disk.
struct FileError : std::runtime_error {
  FileError(const std::string& file_, const std::string& cause) : std::runtime_error(file_ + ": " + cause), file(file_)
  {
  }

  std::string file;
};

}  // namespace tamp::runtime
