#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/ranks/communicator.hpp"

/// HDF5's C library: handles that close themselves, and files whose every failure is a FileError.
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

  /// The result of closing; negative where it failed. Closing a file is where its last parts are written.
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

/// The type of an element in a file, where it is little-endian, and the same in memory.
struct ElementType {
  hid_t in_file;
  hid_t in_memory;
};

template <class T>
ElementType element_type()
{
  if constexpr (std::is_same_v<T, double>) {
    return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return {H5T_STD_I64LE, H5T_NATIVE_INT64};
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return {H5T_STD_U64LE, H5T_NATIVE_UINT64};
  } else {
    static_assert(std::is_same_v<T, std::byte>);
    return {H5T_STD_U8LE, H5T_NATIVE_UINT8};
  }
}

/// A box of a dataset's elements: the first along each dimension, and how many.
struct Slab {
  std::vector<hsize_t> first;
  std::vector<hsize_t> n;
};

/// The dimensions of a dataset, and the boxes of it that one rank gives.
struct Share {
  std::vector<hsize_t> dimensions;
  std::vector<Slab> slabs;
};

/// A dataset without its values.
struct DatasetInfo {
  std::vector<hsize_t> dimensions;
  bool whole_numbers = false;
  /// The place in the file behind its last byte; 0 if it has none.
  std::uintmax_t end = 0;
};

enum class MemberOrder { by_name, as_made };

/// Shared by the locations of an open file.
struct FileState {
  Quiet quiet;
  std::filesystem::path path;
  std::string doing;
  Communicator communicator;
  Properties transfer;
  File id;
  /// Why values could not be written on this rank.
  std::string failure;
};

/// An open file, or a group in it. What it has is named by paths from it. All throws FileError.
///
/// Where ranks have opened a file together, all of them make the same calls that write.
class Location
{
 public:
  /// The path of the file.
  const std::filesystem::path& file() const { return file_->path; }

  /// Makes a group, and those on the way to it, which know in which order their members were made.
  Location make_group(const std::string& path) const;
  /// Writes an attribute; a single value becomes a scalar.
  void write_attribute(const std::string& name, std::span<const double> values) const
  {
    write_attribute(name, element_type<double>(), values.size(), values.data());
  }
  void write_attribute(const std::string& name, std::span<const std::int64_t> values) const
  {
    write_attribute(name, element_type<std::int64_t>(), values.size(), values.data());
  }
  void write_attribute(const std::string& name, const std::string& text) const;
  /// Makes a dataset; this rank gives the values of its share, in the order of the file. What fails on one rank alone
  /// is kept until `OpenFile::agree`: the calls that follow are made all the same, as other ranks wait in them.
  void write(const std::string& path, const Share& share, ElementType type, const void* values) const;
  /// Writes a dataset whose values the first rank has.
  void write_from_first(const std::string& path, const std::vector<hsize_t>& dimensions, ElementType type,
                        const void* values) const;
  void write_from_first(const std::string& path, const std::string& text) const;
  void remove(const std::string& path) const;

  Location group(const std::string& path) const;
  std::vector<std::string> members(MemberOrder order) const;
  /// Throws too unless there are as many values.
  void read_attribute(const std::string& name, std::span<double> values) const
  {
    read_attribute(name, element_type<double>(), values.size(), values.data());
  }
  void read_attribute(const std::string& name, std::span<std::int64_t> values) const
  {
    read_attribute(name, element_type<std::int64_t>(), values.size(), values.data());
  }
  std::string text_attribute(const std::string& name) const;
  DatasetInfo info(const std::string& path) const;
  /// Values of a dataset: those of a box, in its order, or all.
  void read(const std::string& path, const Slab& box, ElementType type, void* values) const;
  template <class T>
  std::vector<T> read(const std::string& path) const
  {
    const std::vector<hsize_t> n = info(path).dimensions;
    std::vector<T> values(std::accumulate(n.begin(), n.end(), std::size_t{1}, std::multiplies<>()));
    read(path, {std::vector<hsize_t>(n.size(), 0), n}, element_type<T>(), values.data());
    return values;
  }
  std::string read_text(const std::string& path) const;

 private:
  friend class OpenFile;
  explicit Location(std::shared_ptr<FileState> file, Group group = Group())
      : file_(std::move(file)), group_(std::move(group))
  {
  }

  hid_t id() const { return group_ < 0 ? hid_t{file_->id} : hid_t{group_}; }
  hid_t checked(hid_t result) const;
  void write_attribute(const std::string& name, ElementType type, hsize_t n, const void* values) const;
  void read_attribute(const std::string& name, ElementType type, std::size_t n, void* values) const;
  /// Selects the elements of all slabs together, none without one, and gives their space in memory: one after another.
  Space select(const Space& in_file, std::span<const Slab> slabs) const;

  std::shared_ptr<FileState> file_;
  /// None where it is the file itself.
  Group group_;
};

/// A file opened by all ranks together, or by this process where it is alone: without locks, because a reader such as
/// ParaView that has the file open would otherwise stop the run at its next output. The calls below are collective;
/// what fails on one rank throws on all.
class OpenFile : public Location
{
 public:
  enum class Access { read, write };

  /// `doing` is what errors say of the calls that follow: "cannot write step 12".
  OpenFile(const std::filesystem::path& file, Access access, std::string doing, const Communicator& communicator = {});

  const Communicator& communicator() const { return file_->communicator; }

  /// A group that no path leads to until it is linked.
  Location make_loose_group() const;
  void link(const Location& loose_group, const std::string& path) const;
  /// Throws if values could not be written on one rank.
  void agree() const;
  /// Puts everything on disk.
  void flush() const;
  /// Closes the file, once its groups have gone.
  void close() const;
};

/// Makes an empty file, in the place of one that is there, with room at its front for `n_front` bytes that HDF5 leaves
/// alone: 0, or 512 times a power of two. Of one process.
void create_file(const std::filesystem::path& file, std::size_t n_front = 0);

/// How much of a file that is closed is in use: it may be longer by room that was reserved.
std::uintmax_t used_size(const std::filesystem::path& file);

}  // namespace tamp::runtime::hdf5
