#pragma once

#include <cstdint>
#include <filesystem>

namespace tamp::runtime
{

/// Lengthens a file by `n_bytes`, with room on the disk behind every byte, so that what is written there next cannot
/// run out of it: a library that fails in the middle of an update may leave a file that nobody can read. Throws
/// FileError, and leaves the file as it was, if there is no such room.
void reserve_room(const std::filesystem::path& file, std::int64_t n_bytes);

/// Cuts a file to the `size` that is in use of it, unless it is shorter. Throws FileError.
void give_back_room(const std::filesystem::path& file, std::uintmax_t size);

}  // namespace tamp::runtime
