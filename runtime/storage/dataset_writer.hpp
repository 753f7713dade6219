#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/storage/hdf5.hpp"

namespace tamp::runtime
{

/// A number's type in a file and the same in memory.
struct StoredType {
  hid_t in_file;
  hid_t in_memory;
};

/// Writes datasets of an open file, all ranks together. What fails on one rank alone is kept until `agree`: the calls
/// that follow are made all the same, as other ranks wait in them.
class DatasetWriter
{
 public:
  /// `doing` reads like "cannot write step 12".
  DatasetWriter(std::filesystem::path file, std::string doing, const Communicator& communicator);

  /// Makes a dataset of these dimensions; this rank gives the values of its slabs, in the order of the file.
  void write(hid_t at, const std::string& name, std::span<const hsize_t> dimensions, std::span<const hdf5::Slab> slabs,
             StoredType type, const void* values);
  /// Throws FileError on all ranks if values could not be written on one.
  void agree() const;

 private:
  hid_t checked(hid_t result) const { return hdf5::checked(result, file_, doing_); }

  std::filesystem::path file_;
  std::string doing_;
  Communicator communicator_;
  hdf5::Properties transfer_;
  std::string failure_;
};

}  // namespace tamp::runtime
