#include "runtime/storage/field_file.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "runtime/storage/hdf5.hpp"
#include "runtime/storage/reserve_room.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

/// How files are opened. Without locks, because a reader such as ParaView that has the file open would otherwise stop
/// the run at its next output. Ranks that write one file together would name their communicator here.
hdf5::Properties file_access(const std::filesystem::path& file)
{
  hdf5::Properties access(hdf5::checked(H5Pcreate(H5P_FILE_ACCESS), file, "cannot prepare access"));
  hdf5::checked(H5Pset_file_locking(access, false, true), file, "cannot prepare access");
  return access;
}

/// Writes one step into an open file; each error names the file and the step.
class StepWriter
{
 public:
  StepWriter(hid_t file, const std::filesystem::path& name, std::int64_t step)
      : name_(name), doing_(fmt::format("cannot write step {}", step)), path_(fmt::format("/step_{:08}", step))
  {
    group_ = make_group(file, path_);
  }

  void write_time(double time) const
  {
    const hdf5::Space space(checked(H5Screate(H5S_SCALAR)));
    const hdf5::Attribute attribute(
        checked(H5Acreate2(group_, "time", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT)));
    checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &time));
  }

  XdmfParticles write(const ParticleBlock& block) const
  {
    const std::string path = path_ + "/particles/" + block.name;
    const hdf5::Group group = make_group(group_, path);
    XdmfParticles written{block.name, block.n, {}};
    for (const Column& column : block.columns) written.columns.push_back(write(group, path, column, {block.n}));
    return written;
  }

  XdmfNodes write(const NodeBlock& block) const
  {
    const std::string path = path_ + "/nodes";
    const hdf5::Group group = make_group(group_, path);
    const auto n = [&](std::size_t axis) { return static_cast<hsize_t>(block.n_nodes[axis]); };
    XdmfNodes written{block.origin, block.spacing, block.n_nodes, {}};
    for (const Column& column : block.columns) {
      written.columns.push_back(write(group, path, column, {n(2), n(1), n(0)}));
    }
    return written;
  }

 private:
  hid_t checked(hid_t result) const { return hdf5::checked(result, name_, doing_); }

  /// Makes the groups on the way to `path` too.
  hdf5::Group make_group(hid_t at, const std::string& path) const
  {
    const hdf5::Properties links(checked(H5Pcreate(H5P_LINK_CREATE)));
    checked(H5Pset_create_intermediate_group(links, 1));
    return hdf5::Group(checked(H5Gcreate2(at, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT)));
  }

  XdmfColumn write(hid_t group, const std::string& path, const Column& column, std::vector<hsize_t> dimensions) const
  {
    std::size_t n_items = 1;
    for (const hsize_t n : dimensions) n_items *= n;
    const bool whole_numbers = std::holds_alternative<std::span<const std::int64_t>>(column.values);
    if (whole_numbers) {
      const auto& ids = std::get<std::span<const std::int64_t>>(column.values);
      if (ids.size() != n_items || column.kind != ColumnKind::scalar) {
        throw std::invalid_argument(fmt::format("column '{}': {} ids for {} items", column.name, ids.size(), n_items));
      }
      write_dataset(group, column.name, dimensions, H5T_STD_I64LE, H5T_NATIVE_INT64, ids.data());
    } else {
      const std::vector<double> values = as_in_file(column, n_items);
      if (column.kind != ColumnKind::scalar) dimensions.push_back(n_in_file(column.kind));
      write_dataset(group, column.name, dimensions, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
    }
    return {column.name, column.kind, whole_numbers,
            fmt::format("{}:{}/{}", name_.filename().string(), path, column.name)};
  }

  void write_dataset(hid_t group, const std::string& name, const std::vector<hsize_t>& dimensions, hid_t type_in_file,
                     hid_t type_in_memory, const void* values) const
  {
    const hdf5::Space space(checked(H5Screate_simple(static_cast<int>(dimensions.size()), dimensions.data(), nullptr)));
    const hdf5::Dataset dataset(
        checked(H5Dcreate2(group, name.c_str(), type_in_file, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)));
    checked(H5Dwrite(dataset, type_in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  }

  const std::filesystem::path& name_;
  std::string doing_;
  std::string path_;
  hdf5::Group group_;
};

std::size_t n_nodes(const NodeBlock& nodes)
{
  std::size_t n = 1;
  for (const int along_axis : nodes.n_nodes) n *= static_cast<std::size_t>(along_axis);
  return n;
}

/// No less than a step takes in the file.
std::int64_t size_in_file(std::span<const ParticleBlock> particles, const std::optional<NodeBlock>& nodes)
{
  constexpr std::size_t of_group = 16384, of_dataset = 4096;
  std::size_t n_bytes = 4 * of_group;
  const auto add = [&](const std::vector<Column>& columns, std::size_t n_items) {
    n_bytes += of_group;
    for (const Column& column : columns) n_bytes += of_dataset + 8 * n_in_file(column.kind) * n_items;
  };
  for (const ParticleBlock& block : particles) add(block.columns, block.n);
  if (nodes) add(nodes->columns, n_nodes(*nodes));
  return static_cast<std::int64_t>(n_bytes);
}

}  // namespace

FieldFile::FieldFile(const std::filesystem::path& folder)
    : hdf5_file_(folder / "fields.h5"), xdmf_file_(folder / "fields.xdmf")
{
  const hdf5::Quiet quiet;
  const hdf5::Properties access = file_access(hdf5_file_);
  hdf5::File file(hdf5::checked(H5Fcreate(hdf5_file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), hdf5_file_,
                                "cannot be created"));
  hdf5::checked(file.close(), hdf5_file_, "cannot be created");
  write_whole_file(xdmf_file_, xdmf_text(steps_));
}

void FieldFile::write_step(std::int64_t step, double time, std::span<const ParticleBlock> particles,
                           const std::optional<NodeBlock>& nodes)
{
  reserve_room(hdf5_file_, size_in_file(particles, nodes));
  const hdf5::Quiet quiet;
  const hdf5::Properties access = file_access(hdf5_file_);
  hdf5::File file(
      hdf5::checked(H5Fopen(hdf5_file_.c_str(), H5F_ACC_RDWR, access), hdf5_file_, "cannot be opened for writing"));
  XdmfStep written{time, {}, {}};
  {
    const StepWriter writer(file, hdf5_file_, step);
    writer.write_time(time);
    for (const ParticleBlock& block : particles) written.particles.push_back(writer.write(block));
    if (nodes) written.nodes = writer.write(*nodes);
  }
  const std::string doing = fmt::format("cannot write step {}", step);
  hdf5::checked(H5Fflush(file, H5F_SCOPE_LOCAL), hdf5_file_, doing);
  hdf5::checked(file.close(), hdf5_file_, doing);
  steps_.push_back(std::move(written));
  write_whole_file(xdmf_file_, xdmf_text(steps_));
}

}  // namespace tamp::runtime
