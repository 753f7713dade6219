#pragma once

#include <stdexcept>
#include <string>

namespace tamp::runtime
{

/// A file that could not be read or written as it should: missing, forbidden, damaged, or no room left on the disk.
struct FileError : std::runtime_error {
  FileError(const std::string& file_, const std::string& cause_)
      : std::runtime_error(file_ + ": " + cause_), file(file_), cause(cause_)
  {
  }

  std::string file;
  std::string cause;
};

}  // namespace tamp::runtime
