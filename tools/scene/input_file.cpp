#include "tools/scene/input_file.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <fstream>
#include <span>

#include "runtime/file_error.hpp"
#include "runtime/storage/checksum.hpp"
#include "tools/errors.hpp"

namespace tamp::tools
{

void expect_input_file(const std::filesystem::path& file)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw runtime::FileError(file.string(), "no such file");
  if (status.type() == std::filesystem::file_type::none) throw runtime::FileError(file.string(), error.message());
  if (std::filesystem::is_directory(status)) throw runtime::FileError(file.string(), "cannot be read");
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError({file.string(), "a pipe, a device or a socket", "expected a file"});
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > most_input_bytes) {
    throw InputError(
        {file.string(), fmt::format("{} bytes", size), fmt::format("expected at most {}", most_input_bytes)});
  }
}

std::string read_input_file(const std::filesystem::path& file)
{
  expect_input_file(file);
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::filesystem::file_size(file), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad()) throw runtime::FileError(file.string(), "cannot be read");
  return text;
}

std::string hash_of(const std::string& text)
{
  return fmt::format("{:016x}", runtime::checksum(std::as_bytes(std::span(text))));
}

}  // namespace tamp::tools
