#pragma once

#include <hdf5.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Files read by another route than they were written: through HDF5's own calls.
namespace tamp::test
{

struct Dataset {
  std::vector<hsize_t> dimensions;
  std::vector<double> values;
};

/// Converted to doubles.
inline Dataset read_dataset(const std::filesystem::path& file, const std::string& name)
{
  Dataset read;
  const hid_t f = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t d = H5Dopen2(f, name.c_str(), H5P_DEFAULT);
  const hid_t space = H5Dget_space(d);
  read.dimensions.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, read.dimensions.data(), nullptr);
  read.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(d, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.values.data());
  H5Sclose(space);
  H5Dclose(d);
  H5Fclose(f);
  return read;
}

/// The bytes of every dataset of a file, by its path.
inline std::map<std::string, std::vector<std::byte>> all_datasets(const std::filesystem::path& file)
{
  std::map<std::string, std::vector<std::byte>> found;
  const hid_t f = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto add = [](hid_t at, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const hid_t d = H5Dopen2(at, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(d);
    const hid_t type = H5Dget_type(d);
    const auto n = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * H5Tget_size(type);
    auto& bytes = (*static_cast<std::map<std::string, std::vector<std::byte>>*>(data))[name];
    bytes.resize(n);
    H5Dread(d, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(d);
    return 0;
  };
  H5Ovisit2(f, H5_INDEX_NAME, H5_ITER_INC, add, &found, H5O_INFO_BASIC);
  H5Fclose(f);
  return found;
}

}  // namespace tamp::test
