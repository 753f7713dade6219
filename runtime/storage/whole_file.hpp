#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace tamp::runtime
{

/// A file that is written whole or not at all: a reader sees the old content or the new, whenever it looks and however
/// the program ends. A link stays one, and what it points to is replaced. What is no regular file, such as a pipe or a
/// device, stays what it is: it is written to directly. All throw FileError; an old file is then left as it was.
///
/// Until it is published it is FILE.part. What a program that was killed has left under that name is removed.
class WholeFile
{
 public:
  explicit WholeFile(std::filesystem::path file);
  /// Forgets what was written, unless it was published.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view text);
  /// Gives the content its name.
  void publish();

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };

  [[noreturn]] void fail(int cause) const;
  bool is_direct() const { return part_.empty(); }

  std::filesystem::path file_;
  /// Beside what is to be replaced; empty for what is written to directly.
  std::filesystem::path part_;
  std::filesystem::path target_;
  std::unique_ptr<std::FILE, Close> stream_;
};

/// Writes a whole file at once.
void write_whole_file(const std::filesystem::path& file, std::string_view content);

/// Throws FileError for a pipe, a device or a socket. Whoever opens a pipe waits for its other end, and signals that
/// are handled go unheard meanwhile.
void expect_no_stream(const std::filesystem::path& file);

/// Throws FileError where a file cannot be written whole: what takes long to find out asks before.
void expect_writable(const std::filesystem::path& file);

/// FILE.damaged, or the first of FILE.damaged.2, FILE.damaged.3 ... that is not there yet.
std::filesystem::path name_aside(const std::filesystem::path& file);

/// Gives a finished file the name under which it is looked for, once it is on the disk and not only on its way there:
/// whoever finds it finds all of it, even after the power has failed. Throws FileError.
void publish_file(const std::filesystem::path& part, const std::filesystem::path& file);

/// Lengthens a file by `n_bytes`, with room on the disk behind every byte, so that what is written there next cannot
/// run out of it: a library that fails in the middle of an update may leave a file that nobody can read. Throws
/// FileError, and leaves the file as it was, if there is no such room.
void reserve_room(const std::filesystem::path& file, std::int64_t n_bytes);

/// Cuts a file to the `size` that is in use of it, unless it is shorter. Throws FileError.
void release_room(const std::filesystem::path& file, std::uintmax_t size);

}  // namespace tamp::runtime
