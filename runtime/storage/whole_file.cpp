#include "runtime/storage/whole_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "runtime/storage/file_error.hpp"

namespace tamp::runtime
{

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

}  // namespace tamp::runtime
