#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/storage/checkpoint_header.hpp"
#include "runtime/storage/hdf5.hpp"
#include "runtime/storage/state_tables.hpp"

namespace tamp::runtime
{

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

  explicit CheckpointReader(std::filesystem::path file);

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
  hid_t checked(hid_t result) const { return hdf5::checked(result, file_, "cannot be read"); }
  std::vector<std::int64_t> numbers(const char* attribute, std::size_t n) const;
  std::string text(const char* attribute) const;
  std::vector<Table> read_contents() const;
  std::vector<PatchEntry> read_entries(const std::string& path) const;

  hdf5::Quiet quiet_;
  std::filesystem::path file_;
  hdf5::File opened_;
  std::vector<Table> tables_;
};

}  // namespace tamp::runtime
