#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/checkpoints/checkpoint.hpp"
#include "runtime/storage/checkpoints/state_tables.hpp"
#include "runtime/storage/hdf5.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// Version of what stands where in a checkpoint.
inline constexpr std::int64_t checkpoint_format = 4;

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

/// Looks into a checkpoint whose seal has been checked. Of one process; each rank may have its own. All throws
/// FileError.
class CheckpointReader
{
 public:
  /// A table of the file, and what it says of each patch.
  struct Table {
    std::string path;
    std::size_t value_bytes = 0;
    std::vector<PatchEntry> entries;
  };

  explicit CheckpointReader(const std::filesystem::path& file);

  CheckpointHeader header() const;
  std::vector<std::byte> host() const;
  const std::vector<Table>& tables() const { return tables_; }
  /// Throws unless the file is of these patches and groups.
  void expect(const PatchLayout& layout, std::span<const std::string> group_names) const;

  /// The bytes of the values of a patch, which agree with their checksum.
  std::vector<std::byte> read(const Table& table, std::size_t patch) const;
  /// Reads every `n_shares`-th part of the file, from part `share` on, for its checksums alone.
  void check_share(std::size_t share, std::size_t n_shares) const;

 private:
  std::vector<Table> read_contents() const;
  std::vector<PatchEntry> read_entries(const std::string& path) const;

  hdf5::OpenFile file_;
  std::vector<Table> tables_;
};

}  // namespace tamp::runtime
