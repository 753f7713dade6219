#include "runtime/storage/fields/field_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "runtime/file_error.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/fields/item_place.hpp"
#include "runtime/storage/fields/stored_step.hpp"
#include "runtime/storage/hdf5.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime
{

namespace
{

/// No less than a step takes in the file. Throws std::invalid_argument for blocks that cannot be written.
std::int64_t checked_size(std::span<const ParticleBlock> particles, const std::optional<NodeBlock>& nodes)
{
  constexpr std::size_t of_group = 16384, of_dataset = 4096;
  std::size_t n_bytes = 4 * of_group;
  const auto add = [&](const std::vector<Column>& columns, const ItemPlace& place) {
    n_bytes += of_group;
    for (const Column& column : columns) {
      check(column, place.n_own);
      n_bytes += of_dataset + 8 * n_in_file(column.kind) * place.n_total();
    }
  };
  std::size_t n_vertices = 0;
  for (const ParticleBlock& block : particles) {
    add(block.columns, place_of(block));
    n_vertices = std::max(n_vertices, place_of(block).n_total());
  }
  n_bytes += of_dataset + sizeof(std::int64_t) * n_vertices;
  if (nodes) add(nodes->columns, place_of(*nodes));
  return static_cast<std::int64_t>(n_bytes);
}

std::size_t n_listed(std::span<const XdmfStep> steps)
{
  std::size_t n = 0;
  for (const XdmfStep& step : steps) n = std::max(n, step.vertices ? step.vertices->n : 0);
  return n;
}

}  // namespace

FieldFile::FieldFile(Unopened, const std::filesystem::path& folder, const Communicator& communicator)
    : hdf5_file_(folder / "fields.h5"), xdmf_file_(folder / "fields.xdmf"), communicator_(communicator)
{
}

FieldFile::FieldFile(const std::filesystem::path& folder, const Communicator& communicator)
    : FieldFile(Unopened{}, folder, communicator)
{
  on_first_rank(communicator_, [&] {
    begin();
    state_ = state_of(hdf5_file_);
  });
}

FieldFile FieldFile::continued(const std::filesystem::path& folder, std::int64_t last_step, std::size_t n_expected,
                               const Communicator& communicator)
{
  FieldFile file(Unopened{}, folder, communicator);
  on_first_rank(communicator, [&] {
    file.begin_or_continue(last_step, n_expected);
    file.state_ = state_of(file.hdf5_file_);
  });
  return file;
}

void FieldFile::begin() const
{
  expect_no_stream(hdf5_file_);
  // Under its own name there is none before it is whole.
  const std::filesystem::path part = hdf5_file_.string() + ".part";
  hdf5::create_file(part);
  if (std::rename(part.c_str(), hdf5_file_.c_str()) != 0) throw FileError(hdf5_file_.string(), std::strerror(errno));
  write_xdmf();
}

void FieldFile::write_xdmf() const
{
  expect_no_stream(xdmf_file_);
  write_whole_file(xdmf_file_, xdmf_text(steps_));
}

void FieldFile::begin_or_continue(std::int64_t last_step, std::size_t n_expected)
{
  expect_no_stream(hdf5_file_);
  const bool missing = !std::filesystem::exists(hdf5_file_);
  // HDF5 takes a file of no length for a new one.
  if (missing || std::filesystem::file_size(hdf5_file_) == 0) {
    notice_ = fmt::format("{}: is {}, with the {} outputs until step {}; it was begun anew", hdf5_file_.string(),
                          missing ? "missing" : "empty", n_expected, last_step);
    return begin();
  }
  // A file without permission to read or write is not damaged.
  if (faccessat(AT_FDCWD, hdf5_file_.c_str(), R_OK | W_OK, AT_EACCESS) != 0) {
    throw FileError(hdf5_file_.string(), std::strerror(errno));
  }
  try {
    steps_ = cut_to_step(hdf5_file_, last_step);
    write_xdmf();
    if (steps_.size() != n_expected) {
      notice_ = fmt::format("{}: has {} outputs until step {}, of {} that were written; they were kept",
                            hdf5_file_.string(), steps_.size(), last_step, n_expected);
    }
  } catch (const FileError& error) {
    if (error.file != hdf5_file_) throw;
    const std::filesystem::path aside = name_aside(hdf5_file_);
    std::error_code refused;
    std::filesystem::rename(hdf5_file_, aside, refused);
    if (refused) throw;
    notice_ = fmt::format("{}; it was set aside as {} and begun anew", error.what(), aside.filename().string());
    begin();
  }
}

void FieldFile::write_step(std::int64_t step, double time, std::span<const ParticleBlock> particles,
                           const std::optional<NodeBlock>& nodes)
{
  on_all_ranks(communicator_, [&] {
    const std::int64_t n_bytes = checked_size(particles, nodes);
    if (!communicator_.is_first()) return;
    expect_as_written();
    state_.reset();  // nothing is known of a file that was written in part
    reserve_room(hdf5_file_, n_bytes);
  });
  // Only the first rank knows the steps.
  const std::size_t n = communicator_.sum(n_listed(steps_));
  XdmfStep written = add_step(hdf5_file_, step, time, particles, nodes, n, communicator_);
  on_first_rank(communicator_, [&] {
    release_room(hdf5_file_, hdf5::used_size(hdf5_file_));
    state_ = state_of(hdf5_file_);
    steps_.push_back(std::move(written));
    write_xdmf();
  });
}

void FieldFile::expect_as_written() const
{
  if (state_) expect_as_left(hdf5_file_, *state_);
}

}  // namespace tamp::runtime
