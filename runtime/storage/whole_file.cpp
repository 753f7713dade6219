#include "runtime/storage/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "runtime/file_error.hpp"

namespace tamp::runtime
{

namespace
{

/// Waits until the disk has a file or the entries of a folder.
void settle(const std::filesystem::path& file)
{
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool settled = descriptor >= 0 && fsync(descriptor) == 0;
  const int cause = errno;
  if (descriptor >= 0) close(descriptor);
  if (!settled) throw FileError(file.string(), std::strerror(cause));
}

}  // namespace

void write_whole_file(const std::filesystem::path& file, const std::string& content)
{
  std::filesystem::path part = file;
  part += ".part";
  std::FILE* stream = std::fopen(part.c_str(), "wb");
  if (stream == nullptr) throw FileError(file.string(), std::strerror(errno));
  errno = 0;
  const bool written = std::fwrite(content.data(), 1, content.size(), stream) == content.size();
  int cause = written ? 0 : errno;
  // A full disk may show only when the stream is closed.
  if (std::fclose(stream) != 0 && cause == 0) cause = errno;
  if (cause == 0 && std::rename(part.c_str(), file.c_str()) != 0) cause = errno;
  if (cause == 0) return;
  std::remove(part.c_str());
  throw FileError(file.string(), std::strerror(cause));
}

std::filesystem::path name_aside(const std::filesystem::path& file)
{
  const std::string first = file.string() + ".damaged";
  std::filesystem::path name = first;
  for (int n = 2; std::filesystem::exists(name); ++n) name = first + "." + std::to_string(n);
  return name;
}

void publish_file(const std::filesystem::path& part, const std::filesystem::path& file)
{
  settle(part);
  if (std::rename(part.c_str(), file.c_str()) != 0) throw FileError(file.string(), std::strerror(errno));
  settle(file.parent_path());
}

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
