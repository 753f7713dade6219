#include "runtime/storage/temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "runtime/file_error.hpp"

namespace tamp::runtime
{

TemporaryFolder::TemporaryFolder(const Communicator& communicator) : communicator_(communicator)
{
  std::string name = (std::filesystem::temp_directory_path() / "tamp_XXXXXX").string();
  if (communicator.is_first() && mkdtemp(name.data()) == nullptr) throw FileError(name, std::strerror(errno));
  path_ = communicator.gather(name).front();
}

TemporaryFolder::~TemporaryFolder()
{
  communicator_.barrier();
  std::error_code stays;
  if (communicator_.is_first()) std::filesystem::remove_all(path_, stays);
}

}  // namespace tamp::runtime
