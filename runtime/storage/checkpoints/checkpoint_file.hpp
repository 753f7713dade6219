#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/checkpoints/checkpoint.hpp"
#include "runtime/storage/checkpoints/state_tables.hpp"
#include "runtime/storage/hdf5.hpp"
#include "runtime/storage/row_share.hpp"

namespace tamp::runtime
{

/// Version of what stands where in a checkpoint.
inline constexpr std::int64_t checkpoint_format = 8;

/// This rank's rows of a table.
struct OwnRows {
  RowShare share;
  std::vector<std::byte> bytes;
};

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
/// Each value stands in the same row whatever rank has its patch. `rows_of` gives those of a table, by its place, and
/// is asked once for each, in their order. Collective; throws FileError on all ranks.
void write_checkpoint_file(const std::filesystem::path& file, const CheckpointContents& contents,
                           const std::function<OwnRows(std::size_t table)>& rows_of, const Communicator& communicator);

/// Looks into a checkpoint whose seal has been checked. Of one process; each rank may have its own. All throws
/// FileError.
class CheckpointReader
{
 public:
  explicit CheckpointReader(const std::filesystem::path& file);

  CheckpointHeader header() const;
  std::vector<std::byte> host() const;
  const std::vector<CheckpointTable>& tables() const { return tables_; }
  /// Throws unless the file is of these patches and groups.
  void expect(const PatchLayout& layout, std::span<const std::string> group_names) const;

  /// The bytes of the values of a patch, which agree with their checksum.
  std::vector<std::byte> read(const CheckpointTable& table, std::size_t patch) const;
  /// Reads every `n_shares`-th part of the file, from part `share` on, for its checksums alone.
  void check_share(std::size_t share, std::size_t n_shares) const;

 private:
  std::vector<CheckpointTable> read_contents() const;
  /// Throws unless the table has the rows that its patches are said to have, which are then read without a further
  /// look.
  void expect_rows(const CheckpointTable& table) const;
  std::vector<PatchEntry> read_entries(const std::string& path) const;

  hdf5::OpenFile file_;
  std::vector<CheckpointTable> tables_;
};

}  // namespace tamp::runtime
