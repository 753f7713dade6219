#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/checkpoint_header.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// Version of what stands where in a checkpoint.
inline constexpr std::int64_t checkpoint_format = 3;

/// Writes the state of all ranks and the host's bytes, the same on all ranks, as a sealed HDF5 file:
///
///     /                        attributes "format", "step", "time" [s], "fingerprint", "patches", "cells", "groups"
///     /contents                bytes of a value and path of each table, a line each
///     /particles/GROUP/LABEL   the values of patch after patch, as rows of 64-bit words (or of bytes, where they are
///     /nodes/GROUP/LABEL       no multiple of eight), so that every bit comes back
///     /cells/GROUP/LABEL
///     /common/nodes/LABEL      of no group
///     /by_patch/TABLE          for each patch its number of values and the checksum of their bytes
///     /host
///
/// The same values stand in the same rows whatever rank has which patch. Collective; throws FileError on all ranks.
void write_checkpoint_file(const std::filesystem::path& file, const CheckpointHeader& header,
                           std::span<const std::byte> host, Warehouse& warehouse,
                           std::span<const std::string> group_names, const Communicator& communicator);

}  // namespace tamp::runtime
