#pragma once

#include <cstddef>
#include <filesystem>

#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// The first bytes of a file that can be sealed: left to the seal by what is written behind them.
inline constexpr std::size_t seal_bytes = 512;

/// Writes into the first bytes of a finished file how long it is and the checksum of all that follows. Collective: the
/// ranks share the reading. Throws FileError on all.
void seal(const std::filesystem::path& file, const Communicator& communicator);

/// Throws FileError on all ranks, with what was found, unless every byte of the file is as it was when it was sealed.
/// So no library has to make sense of a damaged file. Collective, as sealing is.
void check_seal(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace tamp::runtime
