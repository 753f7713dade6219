#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ranks/communicator.hpp"

/// HDF5's C library behind handles that close themselves and calls that throw.
namespace tamp::runtime::hdf5
{

/// An identifier of an open file, group, dataset and so on, closed by `Close` when its holder goes.
template <herr_t (*Close)(hid_t)>
class Handle
{
 public:
  explicit Handle(hid_t id = -1) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept
  {
    std::swap(id_, other.id_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }

  operator hid_t() const { return id_; }

  /// What closing says; negative where it failed. Closing a file is where its last parts are written.
  herr_t close() { return id_ < 0 ? 0 : Close(std::exchange(id_, -1)); }

 private:
  hid_t id_;
};

using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Attribute = Handle<H5Aclose>;
using Properties = Handle<H5Pclose>;

/// Keeps HDF5 from closing files when the program exits, where it crashes over one that could not be closed. All files
/// here are closed by their holders. To be called before any other of its functions.
void close_nothing_at_exit();

/// Keeps HDF5 from writing its own account of errors to stderr while it lives: ours says what is needed.
class Quiet
{
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Throws FileError with HDF5's own reason if `result` is negative; otherwise gives it back. `doing` reads like
/// "cannot write step 12".
hid_t checked(hid_t result, const std::filesystem::path& file, const std::string& doing);

/// How a file is opened: by all ranks together, or by this process where it is alone. Without locks, because a reader
/// such as ParaView that has the file open would otherwise stop the run at its next output.
Properties file_access(const Communicator& communicator, const std::filesystem::path& file);

/// How values are written: by all ranks in one call where there are several.
Properties collective_transfer(const Communicator& communicator, const std::filesystem::path& file);

/// A box of a dataset's elements: the first along each dimension, and how many.
struct Slab {
  std::vector<hsize_t> first;
  std::vector<hsize_t> n;
};

/// Selects the elements of all slabs together; none where there is no slab.
herr_t select(hid_t space, std::span<const Slab> slabs);

/// How much of a file that is closed is in use: it may be longer by room that was reserved.
std::uintmax_t used_size(const std::filesystem::path& file);

}  // namespace tamp::runtime::hdf5
