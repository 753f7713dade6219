#include "runtime/storage/step_writer.hpp"

#include <fmt/core.h>

#include "runtime/ranks/together.hpp"
#include "runtime/storage/reserve_room.hpp"
#include "runtime/storage/step_path.hpp"

namespace tamp::runtime
{

StepWriter::StepWriter(hid_t file, const std::filesystem::path& name, std::int64_t step,
                       const Communicator& communicator)
    : file_(file),
      name_(name),
      communicator_(communicator),
      doing_(fmt::format("cannot write step {}", step)),
      path_(step_path(step)),
      datasets_(name, doing_, communicator)
{
  group_ = hdf5::Group(checked(H5Gcreate_anon(file, ordered_group(), H5P_DEFAULT)));
}

void StepWriter::write_time(double time) const
{
  write_attribute(group_, "time", std::span(&time, 1));
}

XdmfParticles StepWriter::write(const ParticleBlock& block)
{
  const std::string path = "particles/" + block.name;
  const hdf5::Group group = make_group(group_, path);
  const ItemPlace place = place_of(block);
  XdmfParticles written{block.name, place.n_total(), {}};
  for (const Column& column : block.columns) written.columns.push_back(write(group, path, column, place));
  return written;
}

XdmfNodes StepWriter::write(const NodeBlock& block)
{
  const std::string path = "nodes";
  const hdf5::Group group = make_group(group_, path);
  write_attribute(group, "origin", block.origin);
  write_attribute(group, "spacing", std::span(&block.spacing, 1));
  const ItemPlace place = place_of(block);
  XdmfNodes written{block.origin, block.spacing, block.n_nodes, {}};
  for (const Column& column : block.columns) written.columns.push_back(write(group, path, column, place));
  return written;
}

void StepWriter::finish()
{
  const auto flush = [&] { checked(H5Fflush(file_, H5F_SCOPE_GLOBAL)); };
  datasets_.agree();
  together(communicator_, flush);
  // Flushing has given back the room that was reserved.
  constexpr std::int64_t of_link = 65536;
  by_first(communicator_, [&] { reserve_room(name_, of_link); });
  together(communicator_, [&] { checked(H5Olink(group_, file_, path_.c_str(), H5P_DEFAULT, H5P_DEFAULT)); });
  together(communicator_, flush);
}

/// Groups know the order in which their members came, so that a file says in which order its columns are.
hdf5::Properties StepWriter::ordered_group() const
{
  hdf5::Properties properties(checked(H5Pcreate(H5P_GROUP_CREATE)));
  checked(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  constexpr unsigned most_in_header = 64;
  checked(H5Pset_link_phase_change(properties, most_in_header, most_in_header / 2));
  return properties;
}

/// Makes the groups on the way to `path` too.
hdf5::Group StepWriter::make_group(hid_t at, const std::string& path) const
{
  const hdf5::Properties links(checked(H5Pcreate(H5P_LINK_CREATE)));
  checked(H5Pset_create_intermediate_group(links, 1));
  return hdf5::Group(checked(H5Gcreate2(at, path.c_str(), links, ordered_group(), H5P_DEFAULT)));
}

/// A single value as a scalar.
void StepWriter::write_attribute(hid_t object, const char* name, std::span<const double> values) const
{
  const hsize_t n = values.size();
  const hdf5::Space space(checked(n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr)));
  const hdf5::Attribute attribute(checked(H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT)));
  checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()));
}

XdmfColumn StepWriter::write(hid_t group, const std::string& path, const Column& column, const ItemPlace& place)
{
  const auto* const ids = std::get_if<std::span<const std::int64_t>>(&column.values);
  if (ids != nullptr) {
    const auto values = in_file_order(std::vector(ids->begin(), ids->end()), place, 1);
    write_dataset(group, column.name, place, 1, {H5T_STD_I64LE, H5T_NATIVE_INT64}, values.data());
  } else {
    const std::size_t n = n_in_file(column.kind);
    const auto values = in_file_order(as_in_file(column, place.n_own), place, n);
    write_dataset(group, column.name, place, n, {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE}, values.data());
  }
  return {column.name, column.kind, ids != nullptr, dataset_in_xdmf(name_, path_, path, column.name)};
}

void StepWriter::write_dataset(hid_t group, const std::string& name, ItemPlace place, std::size_t n_components,
                               StoredType type, const void* values)
{
  if (n_components > 1) {
    place.dimensions.push_back(n_components);
    for (hdf5::Slab& slab : place.slabs) {
      slab.first.push_back(0);
      slab.n.push_back(n_components);
    }
  }
  datasets_.write(group, name, place.dimensions, place.slabs, type, values);
}

}  // namespace tamp::runtime
