#include "tools/scene/files/input_file.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "runtime/file_error.hpp"
#include "runtime/storage/checksum.hpp"
#include "runtime/storage/file_state.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/shipped_inputs.hpp"

namespace tamp::tools
{

namespace
{

using Identity = std::pair<dev_t, ino_t>;

/// The files that the program has read, each with a name of it. They are kept here so that readers may be called from
/// anywhere, and no file can be forgotten.
struct FilesRead {
  std::mutex mutex;
  std::map<Identity, std::filesystem::path> names;
};

std::optional<Identity> identity_of(const std::filesystem::path& file)
{
  const auto state = runtime::state_of(file);
  if (!state) return std::nullopt;
  return Identity(state->device, state->number);
}

FilesRead& files_read()
{
  static FilesRead files;
  return files;
}

}  // namespace

void note_input(const std::filesystem::path& file)
{
  const auto identity = identity_of(file);
  if (!identity) return;
  const std::scoped_lock lock(files_read().mutex);
  files_read().names.insert_or_assign(*identity, std::filesystem::absolute(file));
}

void note_shipped_inputs()
{
  std::error_code unreadable;
  for (const std::filesystem::path& folder : input_folders()) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, unreadable)) {
      note_input(entry.path());
    }
  }
}

bool is_input(const std::filesystem::path& file)
{
  const auto identity = identity_of(file);
  if (!identity) return false;
  const std::scoped_lock lock(files_read().mutex);
  const auto read = files_read().names.find(*identity);
  // The number of a file that has been removed since is another file's soon.
  return read != files_read().names.end() && identity_of(read->second) == identity;
}

void expect_input_file(const std::filesystem::path& file)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError({file.string(), "no such file", "expected the name of one"});
  }
  if (status.type() == std::filesystem::file_type::none) throw runtime::FileError(file.string(), error.message());
  if (std::filesystem::is_directory(status)) throw InputError({file.string(), "a folder", "expected a file"});
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError({file.string(), "a pipe, a device or a socket", "expected a file"});
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > most_input_bytes) {
    throw InputError(
        {file.string(), fmt::format("{} bytes", size), fmt::format("expected at most {}", most_input_bytes)});
  }
  note_input(file);
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

std::string read_input_text(const std::filesystem::path& file)
{
  return std::string(without_byte_order_mark(read_input_file(file)));
}

std::string_view without_byte_order_mark(std::string_view text)
{
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::string hash_of(const std::string& text)
{
  return fmt::format("{:016x}", runtime::checksum(std::as_bytes(std::span(text))));
}

}  // namespace tamp::tools
