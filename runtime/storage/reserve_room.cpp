#include "runtime/storage/reserve_room.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/file_error.hpp"

namespace tamp::runtime
{

void reserve_room(const std::filesystem::path& file, std::int64_t n_bytes)
{
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw FileError(file.string(), std::strerror(errno));
  const off_t size = lseek(descriptor, 0, SEEK_END);
  const int cause = size < 0 ? errno : posix_fallocate(descriptor, size, n_bytes);
  const bool left_as_it_was = cause == 0 || size < 0 || ftruncate(descriptor, size) == 0;
  close(descriptor);
  if (cause == 0) return;
  throw FileError(file.string(), std::string(std::strerror(cause)) + (left_as_it_was ? "" : ", and is now damaged"));
}

void give_back_room(const std::filesystem::path& file, std::uintmax_t size)
{
  std::error_code error;
  const std::uintmax_t now = std::filesystem::file_size(file, error);
  if (!error && now > size) std::filesystem::resize_file(file, size, error);
  if (error) throw FileError(file.string(), error.message());
}

}  // namespace tamp::runtime
