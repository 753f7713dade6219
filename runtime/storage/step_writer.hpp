#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "runtime/storage/dataset_writer.hpp"
#include "runtime/storage/field_columns.hpp"
#include "runtime/storage/hdf5.hpp"
#include "runtime/storage/item_place.hpp"
#include "runtime/storage/xdmf.hpp"

namespace tamp::runtime
{

/// Writes one step into an open field file. Collective.
///
/// The step is built beside the tree of the file and linked into it at the very end, so that a program killed before
/// leaves the steps before untouched; only the link itself, some hundred bytes, is a moment in which it may not die.
class StepWriter
{
 public:
  StepWriter(hid_t file, const std::filesystem::path& name, std::int64_t step, const Communicator& communicator);

  void write_time(double time) const;
  /// The blocks have passed `check` and `place_of`.
  XdmfParticles write(const ParticleBlock& block);
  XdmfNodes write(const NodeBlock& block);
  /// Puts everything on disk and makes the step part of the file. Throws FileError on all ranks if it failed on one;
  /// the file then has the steps that it had.
  void finish();

 private:
  hid_t checked(hid_t result) const { return hdf5::checked(result, name_, doing_); }
  hdf5::Properties ordered_group() const;
  hdf5::Group make_group(hid_t at, const std::string& path) const;
  void write_attribute(hid_t object, const char* name, std::span<const double> values) const;
  XdmfColumn write(hid_t group, const std::string& path, const Column& column, const ItemPlace& place);
  void write_dataset(hid_t group, const std::string& name, ItemPlace place, std::size_t n_components, StoredType type,
                     const void* values);

  hid_t file_;
  const std::filesystem::path& name_;
  const Communicator& communicator_;
  std::string doing_;
  std::string path_;
  DatasetWriter datasets_;
  hdf5::Group group_;
};

}  // namespace tamp::runtime
