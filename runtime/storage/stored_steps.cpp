#include "runtime/storage/stored_steps.hpp"

#include <algorithm>
#include <charconv>

#include "runtime/file_error.hpp"
#include "runtime/storage/hdf5.hpp"
#include "runtime/storage/step_path.hpp"

namespace tamp::runtime
{

namespace
{

/// Looks into an open field file, of which there are `size` bytes.
class StepReader
{
 public:
  StepReader(hid_t file, const std::filesystem::path& name, std::uintmax_t size) : file_(file), name_(name), size_(size)
  {
  }

  std::vector<std::int64_t> steps() const
  {
    std::vector<std::int64_t> all;
    for (const std::string& name : members(file_, H5_INDEX_NAME)) {
      std::int64_t step = 0;
      const std::size_t digits = step_path(0).find('0') - 1;
      std::from_chars(name.data() + digits, name.data() + name.size(), step);
      if ("/" + name == step_path(step)) all.push_back(step);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  XdmfStep read(std::int64_t step) const
  {
    const std::string path = step_path(step);
    const hdf5::Group group = open(file_, path);
    XdmfStep read{0, {}, {}};
    read_attribute(group, "time", std::span(&read.time, 1));
    for (const std::string& block : members(group, H5_INDEX_CRT_ORDER)) {
      const hdf5::Group inside = open(group, block);
      if (block == "nodes") {
        read.nodes = nodes(inside, path);
      } else {
        for (const std::string& name : members(inside, H5_INDEX_CRT_ORDER)) {
          read.particles.push_back(particles(open(inside, name), path, name));
        }
      }
    }
    return read;
  }

  void remove(std::int64_t step) const { checked(H5Ldelete(file_, step_path(step).c_str(), H5P_DEFAULT)); }

 private:
  /// A dataset's place in the document, and its items along each axis.
  struct StoredColumn {
    XdmfColumn column;
    std::vector<hsize_t> items;
  };

  hid_t checked(hid_t result) const { return hdf5::checked(result, name_, "cannot be read"); }

  hdf5::Group open(hid_t at, const std::string& path) const
  {
    return hdf5::Group(checked(H5Gopen2(at, path.c_str(), H5P_DEFAULT)));
  }

  std::vector<std::string> members(hid_t group, H5_index_t order) const
  {
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
      static_cast<std::vector<std::string>*>(data)->emplace_back(name);
      return 0;
    };
    checked(H5Literate(group, order, H5_ITER_INC, nullptr, add, &names));
    return names;
  }

  void read_attribute(hid_t object, const char* name, std::span<double> values) const
  {
    const hdf5::Attribute attribute(checked(H5Aopen(object, name, H5P_DEFAULT)));
    const hdf5::Space space(checked(H5Aget_space(attribute)));
    if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(values.size())) {
      throw FileError(name_.string(), std::string("has not the numbers of '") + name + "'");
    }
    checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()));
  }

  XdmfParticles particles(const hdf5::Group& group, const std::string& path, const std::string& name) const
  {
    XdmfParticles read{name, 0, {}};
    for (const std::string& column : members(group, H5_INDEX_CRT_ORDER)) {
      const StoredColumn stored = this->column(group, column, 1, path, "particles/" + name);
      read.n = stored.items.front();
      read.columns.push_back(stored.column);
    }
    return read;
  }

  XdmfNodes nodes(const hdf5::Group& group, const std::string& path) const
  {
    XdmfNodes read{{}, 0, {}, {}};
    read_attribute(group, "origin", read.origin);
    read_attribute(group, "spacing", std::span(&read.spacing, 1));
    for (const std::string& column : members(group, H5_INDEX_CRT_ORDER)) {
      const StoredColumn stored = this->column(group, column, 3, path, "nodes");
      for (std::size_t axis = 0; axis < 3; ++axis) read.n_nodes[axis] = static_cast<int>(stored.items[2 - axis]);
      read.columns.push_back(stored.column);
    }
    return read;
  }

  /// Of items that stand along `n_axes` dimensions of the dataset; what is left are components.
  StoredColumn column(const hdf5::Group& group, const std::string& name, std::size_t n_axes, const std::string& path,
                      const std::string& of_group) const
  {
    const hdf5::Dataset dataset(checked(H5Dopen2(group, name.c_str(), H5P_DEFAULT)));
    const hdf5::Space space(checked(H5Dget_space(dataset)));
    const hdf5::Type type(checked(H5Dget_type(dataset)));
    const hsize_t n_bytes = H5Dget_storage_size(dataset);
    if (n_bytes > 0 && H5Dget_offset(dataset) + n_bytes > size_) throw FileError(name_.string(), "is cut off");
    const auto n_dimensions = static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space)));
    if (n_dimensions != n_axes && n_dimensions != n_axes + 1) {
      throw FileError(name_.string(), "has a dataset '" + name + "' of another shape");
    }
    std::vector<hsize_t> items(n_dimensions);
    checked(H5Sget_simple_extent_dims(space, items.data(), nullptr));
    const ColumnKind kind = n_dimensions == n_axes ? ColumnKind::scalar
                            : items.back() == 3    ? ColumnKind::vector
                                                   : ColumnKind::tensor;
    items.resize(n_axes);
    const bool whole_numbers = H5Tget_class(type) == H5T_INTEGER;
    return {{name, kind, whole_numbers, dataset_in_xdmf(name_, path, of_group, name)}, items};
  }

  hid_t file_;
  const std::filesystem::path& name_;
  std::uintmax_t size_;
};

/// Of a file of which `size` bytes are known to have been written.
std::vector<XdmfStep> cut(const std::filesystem::path& name, std::int64_t last_step, std::uintmax_t size)
{
  const hdf5::Properties access = hdf5::file_access({}, name);
  hdf5::File file(hdf5::checked(H5Fopen(name.c_str(), H5F_ACC_RDWR, access), name, "cannot be opened"));
  const StepReader reader(file, name, size);
  std::vector<XdmfStep> kept;
  for (const std::int64_t step : reader.steps()) {
    if (step <= last_step) {
      kept.push_back(reader.read(step));
    } else {
      reader.remove(step);
    }
  }
  hdf5::checked(file.close(), name, "cannot be cut");
  return kept;
}

}  // namespace

std::vector<XdmfStep> cut_to_step(const std::filesystem::path& field_file, std::int64_t last_step)
{
  const hdf5::Quiet quiet;
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(field_file, failed);
  if (failed) throw FileError(field_file.string(), failed.message());
  try {
    return cut(field_file, last_step, size);
  } catch (const FileError&) {
    // Where steps are removed from the end of a file, HDF5 shortens it before it notes its new length, and refuses it
    // if the program was killed between the two: so it gets a second chance, with a hole at its end.
    constexpr std::uintmax_t more_than_any_step = std::uintmax_t{1} << 34;
    std::filesystem::resize_file(field_file, size + more_than_any_step, failed);
    if (failed) throw;
  }
  try {
    return cut(field_file, last_step, size);
  } catch (const FileError&) {
    std::filesystem::resize_file(field_file, size, failed);
    throw;
  }
}

}  // namespace tamp::runtime
