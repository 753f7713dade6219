#include "runtime/storage/dataset_writer.hpp"

#include "runtime/file_error.hpp"
#include "runtime/ranks/together.hpp"

namespace tamp::runtime
{

DatasetWriter::DatasetWriter(std::filesystem::path file, std::string doing, const Communicator& communicator)
    : file_(std::move(file)),
      doing_(std::move(doing)),
      communicator_(communicator),
      transfer_(hdf5::collective_transfer(communicator, file_))
{
}

void DatasetWriter::write(hid_t at, const std::string& name, std::span<const hsize_t> dimensions,
                          std::span<const hdf5::Slab> slabs, StoredType type, const void* values)
{
  const hdf5::Space in_file(checked(H5Screate_simple(static_cast<int>(dimensions.size()), dimensions.data(), nullptr)));
  const hdf5::Properties links(checked(H5Pcreate(H5P_LINK_CREATE)));
  checked(H5Pset_create_intermediate_group(links, 1));
  const hdf5::Dataset dataset(
      checked(H5Dcreate2(at, name.c_str(), type.in_file, in_file, links, H5P_DEFAULT, H5P_DEFAULT)));
  // Nothing to write on any rank; ranks together would fail at it.
  if (checked(H5Sget_simple_extent_npoints(in_file)) == 0) return;
  checked(hdf5::select(in_file, slabs));
  const auto n_own = static_cast<hsize_t>(checked(H5Sget_select_npoints(in_file)));
  const hdf5::Space in_memory(checked(H5Screate_simple(1, &n_own, nullptr)));
  try {
    checked(H5Dwrite(dataset, type.in_memory, in_memory, in_file, transfer_, values));
  } catch (const FileError& error) {
    failure_ = error.cause;
  }
}

void DatasetWriter::agree() const
{
  together(communicator_, [&] {
    if (!failure_.empty()) throw FileError(file_.string(), failure_);
  });
}

}  // namespace tamp::runtime
