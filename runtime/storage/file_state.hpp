#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tamp::runtime
{

/// Which file a name or a descriptor stands for, whatever its other names, and how long it is.
struct FileState {
  dev_t device = 0;
  ino_t number = 0;
  std::uintmax_t n_bytes = 0;

  bool is_same_file(const FileState& other) const { return device == other.device && number == other.number; }
};

/// The state of a file; empty for one that is not there.
std::optional<FileState> state_of(const std::filesystem::path& file);
std::optional<FileState> state_of(int descriptor);

/// Throws FileError unless the name stands for the file that was left there, with the length that it had.
void expect_as_left(const std::filesystem::path& file, const FileState& left);

}  // namespace tamp::runtime
