#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>

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
using Attribute = Handle<H5Aclose>;
using Properties = Handle<H5Pclose>;

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

}  // namespace tamp::runtime::hdf5
