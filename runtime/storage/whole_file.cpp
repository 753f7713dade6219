#include "runtime/storage/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "runtime/file_error.hpp"

namespace tamp::runtime
{

namespace fs = std::filesystem;

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

/// Whether a file is one of /proc/self/fd: a link whose text is no name of a file.
bool is_of_process(const fs::path& file)
{
  return file.string().starts_with("/proc/");
}

/// Where the links of a name lead; a link among the files of a process, such as /dev/stdout, is followed up to there.
fs::path end_of_links(fs::path file)
{
  constexpr int most_links = 40;  // as the system follows
  std::error_code error;
  for (int n = 0; n < most_links && fs::is_symlink(fs::symlink_status(file, error)) && !is_of_process(file); ++n) {
    const fs::path next = fs::read_symlink(file, error);
    if (error) throw FileError(file.string(), error.message());
    file = file.parent_path() / next;
  }
  return file;
}

/// Whether a path takes text but is not replaced: a pipe, a device, an open file of this process.
bool is_stream(const fs::path& file)
{
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status) || fs::is_directory(status)) return false;
  return !fs::is_regular_file(status) || is_of_process(file);
}

/// Opens a file that is not there yet, and so no pipe and no link to another file.
std::FILE* open_part(const fs::path& part)
{
  expect_no_stream(part);
  ::unlink(part.c_str());
  return std::fopen(part.c_str(), "wbx");
}

}  // namespace

WholeFile::WholeFile(fs::path file) : file_(std::move(file)), target_(end_of_links(file_))
{
  if (!is_stream(target_)) (part_ = target_) += ".part";
  // To append leaves alone what others have written to the same open file.
  stream_.reset(is_direct() ? std::fopen(target_.c_str(), "ab") : open_part(part_));
  if (!stream_) fail(errno);
}

WholeFile::~WholeFile()
{
  stream_.reset();
  if (!is_direct()) std::remove(part_.c_str());
}

void WholeFile::write(std::string_view text)
{
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) fail(errno);
}

void WholeFile::publish()
{
  // A full disk may show only when the stream is closed.
  if (std::fclose(stream_.release()) != 0) fail(errno);
  if (!is_direct() && std::rename(part_.c_str(), target_.c_str()) != 0) fail(errno);
}

void WholeFile::fail(int cause) const
{
  throw FileError(file_.string(), std::strerror(cause));
}

void write_whole_file(const fs::path& file, std::string_view content)
{
  WholeFile whole(file);
  whole.write(content);
  whole.publish();
}

void expect_no_stream(const fs::path& file)
{
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status) || fs::is_regular_file(status) || fs::is_directory(status)) return;
  throw FileError(file.string(), "a pipe, a device or a socket; expected a file");
}

void expect_writable(const fs::path& file)
{
  std::error_code none;
  if (fs::is_directory(file, none)) throw FileError(file.string(), std::strerror(EISDIR));
  if (!is_stream(end_of_links(file))) {
    const WholeFile forgotten(file);
  } else if (access(file.c_str(), W_OK) != 0) {
    throw FileError(file.string(), std::strerror(errno));
  }
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
  expect_no_stream(file);
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw FileError(file.string(), std::strerror(errno));
  const off_t size = lseek(descriptor, 0, SEEK_END);
  const int cause = size < 0 ? errno : posix_fallocate(descriptor, size, n_bytes);
  const bool left_as_it_was = cause == 0 || size < 0 || ftruncate(descriptor, size) == 0;
  close(descriptor);
  if (cause == 0) return;
  throw FileError(file.string(), std::string(std::strerror(cause)) + (left_as_it_was ? "" : ", and is now damaged"));
}

void release_room(const std::filesystem::path& file, std::uintmax_t size)
{
  std::error_code error;
  const std::uintmax_t now = std::filesystem::file_size(file, error);
  if (!error && now > size) std::filesystem::resize_file(file, size, error);
  if (error) throw FileError(file.string(), error.message());
}

}  // namespace tamp::runtime
