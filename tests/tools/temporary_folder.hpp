#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "runtime/storage/temporary_folder.hpp"

namespace tamp::test
{

/// A folder for one test.
class TemporaryFolder : public runtime::TemporaryFolder
{
 public:
  /// Makes a file, and gives its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const
  {
    std::filesystem::create_directories((path() / name).parent_path());
    std::ofstream(path() / name) << content;
    return path() / name;
  }
};

inline std::string read_text(const std::filesystem::path& file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace tamp::test
