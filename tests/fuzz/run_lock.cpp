#include "runtime/storage/folder_lock.hpp"
#include "tests/fuzz/readers.hpp"

void tamp::fuzz::run_lock(const std::filesystem::path& file)
{
  const std::filesystem::path folder = file.string() + ".run", lock = folder / runtime::FolderLock::file_name;
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(file, lock, std::filesystem::copy_options::overwrite_existing);
  try {
    runtime::FolderLock taken(folder);
    taken.is_own();
  } catch (const runtime::FolderInUse&) {
  }
}
