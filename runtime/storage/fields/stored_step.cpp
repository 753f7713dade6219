#include "runtime/storage/fields/stored_step.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

#include "runtime/file_error.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/fields/item_place.hpp"
#include "runtime/storage/hdf5.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

constexpr std::string_view prefix_of_steps = "step_";
constexpr const char* vertices_name = "vertices";

std::string name_of_step(std::int64_t step)
{
  return fmt::format("{}{:08}", prefix_of_steps, step);
}

/// The columns of a block: where they stand, and how an XDMF file names that, such as fields.h5:/step_00000012/nodes.
struct StoredBlock {
  hdf5::Location group;
  std::string in_xdmf;

  std::string dataset(const std::string& column) const { return in_xdmf + "/" + column; }
};

/// Makes a step's blocks, or looks into them.
class StoredStep
{
 public:
  StoredStep(hdf5::Location group, std::int64_t step)
      : group_(std::move(group)), in_xdmf_(fmt::format("{}:/{}", group_.file().filename().string(), name_of_step(step)))
  {
  }

  const hdf5::Location& group() const { return group_; }
  std::string dataset(const std::string& name) const { return in_xdmf_ + "/" + name; }
  StoredBlock make(const std::string& path) const { return {group_.make_group(path), in_xdmf_ + "/" + path}; }
  StoredBlock open(const std::string& path) const { return {group_.group(path), in_xdmf_ + "/" + path}; }

 private:
  hdf5::Location group_;
  std::string in_xdmf_;
};

std::string path_of_particles(const std::string& block)
{
  return "particles/" + block;
}

XdmfColumn write_column(const StoredBlock& block, const Column& column, const ItemPlace& place)
{
  const auto* const ids = std::get_if<std::span<const std::int64_t>>(&column.values);
  if (ids != nullptr) {
    const auto values = in_file_order(std::vector(ids->begin(), ids->end()), place, 1);
    block.group.write(column.name, place.share, hdf5::element_type<std::int64_t>(), values.data());
  } else {
    const std::size_t n = n_in_file(column.kind);
    const auto values = in_file_order(as_in_file(column, place.n_own), place, n);
    block.group.write(column.name, share_of(place, n), hdf5::element_type<double>(), values.data());
  }
  return {column.name, column.kind, ids != nullptr, block.dataset(column.name)};
}

XdmfParticles write(const StoredStep& step, const ParticleBlock& block)
{
  const StoredBlock stored = step.make(path_of_particles(block.name));
  const ItemPlace place = place_of(block);
  XdmfParticles written{block.name, place.n_total(), {}};
  for (const Column& column : block.columns) written.columns.push_back(write_column(stored, column, place));
  return written;
}

/// The numbers of the rows of a dataset, of which each rank gives its own.
XdmfVertices write_vertices(const StoredStep& step, const ItemPlace& place)
{
  std::vector<hdf5::Slab> slabs = place.share.slabs;
  std::sort(slabs.begin(), slabs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::int64_t> rows;
  for (const hdf5::Slab& slab : slabs) {
    for (hsize_t k = 0; k < slab.n[0]; ++k) rows.push_back(static_cast<std::int64_t>(slab.first[0] + k));
  }
  step.group().write(vertices_name, place.share, hdf5::element_type<std::int64_t>(), rows.data());
  return {step.dataset(vertices_name), place.n_total()};
}

/// The block with the most particles, of those that a list of `n_listed` is too short for.
const ParticleBlock* longest(std::span<const ParticleBlock> particles, std::size_t n_listed)
{
  const ParticleBlock* found = nullptr;
  for (const ParticleBlock& block : particles) {
    const std::size_t n = place_of(block).n_total();
    if (n > n_listed) found = &block;
    n_listed = std::max(n_listed, n);
  }
  return found;
}

XdmfNodes write(const StoredStep& step, const NodeBlock& block)
{
  const StoredBlock stored = step.make("nodes");
  stored.group.write_attribute("origin", block.origin);
  stored.group.write_attribute("spacing", std::span(&block.spacing, 1));
  const ItemPlace place = place_of(block);
  XdmfNodes written{block.origin, block.spacing, block.n_nodes, {}};
  for (const Column& column : block.columns) written.columns.push_back(write_column(stored, column, place));
  return written;
}

/// Makes a step that is complete part of the file.
void link_step(const hdf5::OpenFile& file, const hdf5::Location& group, std::int64_t step)
{
  file.agree();
  file.flush();
  // Flushing has given back the room that was reserved.
  constexpr std::int64_t of_link = 65536;
  on_first_rank(file.communicator(), [&] { reserve_room(file.file(), of_link); });
  file.link(group, name_of_step(step));
  file.flush();
}

/// Looks into a field file, of which so many bytes are there.
class StepReader
{
 public:
  StepReader(const hdf5::OpenFile& file, std::uintmax_t n_bytes) : file_(file), n_bytes_(n_bytes) {}

  std::vector<std::int64_t> steps() const
  {
    std::vector<std::int64_t> all;
    for (const std::string& name : file_.members(hdf5::MemberOrder::by_name)) {
      std::int64_t step = 0;
      if (name.size() > prefix_of_steps.size()) {
        std::from_chars(name.data() + prefix_of_steps.size(), name.data() + name.size(), step);
      }
      if (name == name_of_step(step)) all.push_back(step);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  XdmfStep read(std::int64_t step) const
  {
    const StoredStep stored(file_.group(name_of_step(step)), step);
    XdmfStep read{0, {}, {}, {}};
    stored.group().read_attribute("time", std::span(&read.time, 1));
    for (const std::string& block : stored.group().members(hdf5::MemberOrder::as_made)) {
      if (block == "nodes") {
        read.nodes = nodes(stored.open(block));
      } else if (block == vertices_name) {
        read.vertices = {stored.dataset(block), checked_info(stored.group(), block).dimensions.at(0)};
      } else {
        for (const std::string& name : stored.group().group(block).members(hdf5::MemberOrder::as_made)) {
          read.particles.push_back(particles(stored.open(path_of_particles(name)), name));
        }
      }
    }
    return read;
  }

 private:
  XdmfParticles particles(const StoredBlock& block, const std::string& name) const
  {
    std::array<hsize_t, 1> n{0};
    std::vector<XdmfColumn> columns = this->columns(block, n);
    return {name, n[0], std::move(columns)};
  }

  XdmfNodes nodes(const StoredBlock& block) const
  {
    XdmfNodes read{{}, 0, {}, {}};
    block.group.read_attribute("origin", read.origin);
    block.group.read_attribute("spacing", std::span(&read.spacing, 1));
    std::array<hsize_t, 3> n{0, 0, 0};
    read.columns = columns(block, n);
    for (std::size_t axis = 0; axis < 3; ++axis) read.n_nodes[axis] = static_cast<int>(n[2 - axis]);
    return read;
  }

  hdf5::DatasetInfo checked_info(const hdf5::Location& group, const std::string& name) const
  {
    hdf5::DatasetInfo info = group.info(name);
    if (info.end > n_bytes_) throw FileError(file_.file().string(), "is cut off");
    return info;
  }

  /// The columns of items that stand along the first dimensions of each dataset, as many as `n_items` has room for;
  /// what is left are components.
  std::vector<XdmfColumn> columns(const StoredBlock& block, std::span<hsize_t> n_items) const
  {
    std::vector<XdmfColumn> all;
    for (const std::string& name : block.group.members(hdf5::MemberOrder::as_made)) {
      const hdf5::DatasetInfo info = checked_info(block.group, name);
      const std::vector<hsize_t>& n = info.dimensions;
      if (n.size() != n_items.size() && n.size() != n_items.size() + 1) {
        throw FileError(file_.file().string(), "has a dataset '" + name + "' of another shape");
      }
      const ColumnKind kind = n.size() == n_items.size() ? ColumnKind::scalar
                              : n.back() == 3            ? ColumnKind::vector
                                                         : ColumnKind::tensor;
      std::copy_n(n.begin(), n_items.size(), n_items.begin());
      all.push_back({name, kind, info.whole_numbers, block.dataset(name)});
    }
    return all;
  }

  const hdf5::OpenFile& file_;
  std::uintmax_t n_bytes_;
};

/// Cuts a file of which `n_bytes` are known to have been written.
std::vector<XdmfStep> cut(const std::filesystem::path& name, std::int64_t last_step, std::uintmax_t n_bytes)
{
  const hdf5::OpenFile file(name, hdf5::OpenFile::Access::write, "cannot be read");
  const StepReader reader(file, n_bytes);
  std::vector<XdmfStep> kept;
  for (const std::int64_t step : reader.steps()) {
    if (step <= last_step) {
      kept.push_back(reader.read(step));
    } else {
      file.remove(name_of_step(step));
    }
  }
  file.close();
  return kept;
}

}  // namespace

XdmfStep add_step(const std::filesystem::path& field_file, std::int64_t step, double time,
                  std::span<const ParticleBlock> particles, const std::optional<NodeBlock>& nodes, std::size_t n_listed,
                  const Communicator& communicator)
{
  const hdf5::OpenFile file(field_file, hdf5::OpenFile::Access::write, fmt::format("cannot write step {}", step),
                            communicator);
  XdmfStep written{time, {}, {}, {}};
  {
    const StoredStep stored(file.make_loose_group(), step);
    stored.group().write_attribute("time", std::span(&time, 1));
    for (const ParticleBlock& block : particles) written.particles.push_back(write(stored, block));
    if (nodes) written.nodes = write(stored, *nodes);
    const ParticleBlock* const unlisted = longest(particles, n_listed);
    if (unlisted != nullptr) written.vertices = write_vertices(stored, place_of(*unlisted));
    link_step(file, stored.group(), step);
  }
  file.close();
  return written;
}

std::vector<XdmfStep> cut_to_step(const std::filesystem::path& field_file, std::int64_t last_step)
{
  std::error_code failed;
  const std::uintmax_t n_bytes = std::filesystem::file_size(field_file, failed);
  if (failed) throw FileError(field_file.string(), failed.message());
  try {
    return cut(field_file, last_step, n_bytes);
  } catch (const FileError&) {
    // Where steps are removed from the end of a file, HDF5 shortens it before it notes its new length, and refuses it
    // if the program was killed between the two: so it gets a second chance, with a hole at its end.
    constexpr std::uintmax_t more_than_any_step = std::uintmax_t{1} << 34;
    std::filesystem::resize_file(field_file, n_bytes + more_than_any_step, failed);
    if (failed) throw;
  }
  try {
    return cut(field_file, last_step, n_bytes);
  } catch (const FileError&) {
    std::filesystem::resize_file(field_file, n_bytes, failed);
    throw;
  }
}

}  // namespace tamp::runtime
