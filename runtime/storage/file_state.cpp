#include "runtime/storage/file_state.hpp"

#include <fmt/core.h>
#include <sys/stat.h>

#include "runtime/file_error.hpp"

namespace tamp::runtime
{

namespace
{

FileState as_state(const struct stat& status)
{
  return {status.st_dev, status.st_ino, static_cast<std::uintmax_t>(status.st_size)};
}

}  // namespace

std::optional<FileState> state_of(const std::filesystem::path& file)
{
  struct stat status {
  };
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return as_state(status);
}

std::optional<FileState> state_of(int descriptor)
{
  struct stat status {
  };
  if (fstat(descriptor, &status) != 0) return std::nullopt;
  return as_state(status);
}

void expect_as_left(const std::filesystem::path& file, const FileState& left)
{
  const std::optional<FileState> now = state_of(file);
  if (!now) throw FileError(file.string(), "was removed by someone else after it was begun");
  if (!now->is_same_file(left)) throw FileError(file.string(), "was replaced by someone else after it was begun");
  if (now->n_bytes == left.n_bytes) return;
  throw FileError(file.string(), fmt::format("was changed by someone else after it was begun: it has {} bytes of {}",
                                             now->n_bytes, left.n_bytes));
}

}  // namespace tamp::runtime
