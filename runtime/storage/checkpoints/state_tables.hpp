#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// The values of one label of the state for one group on one patch.
struct PatchState {
  /// Null where another rank has the patch.
  const Field* field = nullptr;
  /// The patch's own cells or nodes: halos are made anew by the step.
  IndexBox inside;

  std::size_t n_values() const;
  /// The bytes of its values, x fastest, and setting them to others of the same number.
  std::vector<std::byte> bytes() const;
  void append_bytes(std::vector<std::byte>& all) const;
  void set_bytes(std::span<const std::byte> bytes) const;
};

/// The values of one label of the state for one group, over all patches.
struct StateTable {
  /// Path of the table in the file, such as particles/sand/position, cells/sand/temperature, or common/nodes/mass for a
  /// field of no group.
  std::string path;
  std::size_t value_bytes = 0;
  /// A global or an accumulated reduction has one entry instead of one a patch, which all ranks have.
  bool is_one_value = false;
  /// By patch.
  std::vector<PatchState> patches;

  /// Whether it is this rank that writes a patch's values: of what all have, the first.
  bool is_written_by(const Communicator& rank, std::size_t patch) const
  {
    return patches[patch].field != nullptr && (!is_one_value || rank.is_first());
  }
  /// The bytes of all values that this rank writes, patch after patch.
  std::vector<std::byte> bytes_written_by(const Communicator& rank) const;
};

/// All state that a step leaves to the next, the same tables on all ranks.
std::vector<StateTable> state_tables(Warehouse& warehouse, std::span<const std::string> group_names);

/// A file's entry for one patch of a table: how many values it has, and the checksum of their bytes.
struct PatchEntry {
  std::uint64_t n_values = 0;
  std::uint64_t sum = 0;
};

/// A table of a file, without its values: where it stands, and what it says of each patch.
struct CheckpointTable {
  std::string path;
  std::size_t value_bytes = 0;
  std::vector<PatchEntry> entries;
};

/// The entries of patches whose values this rank writes, from its memory; none of others.
std::vector<PatchEntry> own_entries(const StateTable& table, const Communicator& communicator);

/// The tables of all ranks, from what each says of its own patches, table by table. Collective.
std::vector<CheckpointTable> checkpoint_tables(std::span<const StateTable> tables,
                                               std::span<const std::vector<PatchEntry>> own,
                                               const Communicator& communicator);

}  // namespace tamp::runtime
