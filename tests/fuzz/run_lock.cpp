#include <chrono>

#include "runtime/storage/folder_lock.hpp"
#include "tests/fuzz/readers.hpp"

namespace
{

namespace fs = std::filesystem;

void try_to_lock(const fs::path& folder)
{
  try {
    const tamp::runtime::FolderLock taken(folder);
    if (taken.former_holder()) taken.former_holder()->description();
  } catch (const tamp::runtime::FolderInUse&) {
  }
}

}  // namespace

void tamp::fuzz::run_lock(const std::filesystem::path& file)
{
  const fs::path folder = file.string() + ".run", lock = folder / runtime::FolderLock::file_name;
  fs::create_directories(folder);
  fs::copy_file(file, lock, fs::copy_options::overwrite_existing);
  try_to_lock(folder);
  // A copy of the lock, untouched for two minutes.
  fs::copy_file(file, lock, fs::copy_options::overwrite_existing);
  fs::last_write_time(lock, fs::file_time_type::clock::now() - std::chrono::minutes(2));
  try_to_lock(folder);
}
