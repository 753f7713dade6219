#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "runtime/ranks/communicator.hpp"

namespace tamp::test
{

/// A folder of its own for one test, one for all ranks, removed after it.
class TemporaryFolder
{
 public:
  explicit TemporaryFolder(const runtime::Communicator& communicator = {}) : communicator_(communicator)
  {
    std::string name = (std::filesystem::temp_directory_path() / "tamp_storage_XXXXXX").string();
    if (communicator.is_first()) name = mkdtemp(name.data());
    path = communicator.gather(name).front();
  }
  ~TemporaryFolder()
  {
    communicator_.barrier();
    if (communicator_.is_first()) std::filesystem::remove_all(path);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;

 private:
  runtime::Communicator communicator_;
};

}  // namespace tamp::test
