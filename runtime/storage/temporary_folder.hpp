#pragma once

#include <filesystem>
#include <string>

#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// A folder of its own, one for all ranks, that goes with this object. Throws FileError if there can be none.
/// Collective, also where it ends.
class TemporaryFolder
{
 public:
  explicit TemporaryFolder(const Communicator& communicator = {});
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  Communicator communicator_;
  std::filesystem::path path_;
};

}  // namespace tamp::runtime
