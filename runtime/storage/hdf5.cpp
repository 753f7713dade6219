#include "runtime/storage/hdf5.hpp"

#include <algorithm>

#include "runtime/file_error.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::runtime::hdf5
{

namespace
{

namespace fs = std::filesystem;

/// HDF5's error stack, seen from the call that was made towards what failed inside of it.
struct Cause {
  std::string outermost;
  /// The system's message, such as "No space left on device".
  std::string of_system;
};

herr_t take(unsigned, const H5E_error2_t* error, void* data)
{
  auto& cause = *static_cast<Cause*>(data);
  const std::string text = error->desc == nullptr ? "" : error->desc;
  if (cause.outermost.empty()) cause.outermost = text;
  constexpr const char* key = "error message = '";
  const std::size_t begin = text.find(key);
  if (begin != std::string::npos) {
    const std::size_t first = begin + std::char_traits<char>::length(key);
    cause.of_system = text.substr(first, text.find('\'', first) - first);
  }
  return 0;
}

/// Throws FileError with HDF5's own reason if `result` is negative; otherwise gives it back.
hid_t checked(hid_t result, const fs::path& file, const std::string& doing)
{
  if (result >= 0) return result;
  Cause cause;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, take, &cause);
  throw FileError(file.string(), doing + ": " + (cause.of_system.empty() ? cause.outermost : cause.of_system));
}

/// How a file is opened.
Properties file_access(const fs::path& file, const Communicator& communicator)
{
  const std::string doing = "cannot prepare access";
  Properties access(checked(H5Pcreate(H5P_FILE_ACCESS), file, doing));
  checked(H5Pset_file_locking(access, false, true), file, doing);
  // No blocks of which the unused rest is cut off on closing: a program killed there would leave a shorter file than
  // the file itself says, which nobody reads.
  checked(H5Pset_meta_block_size(access, 0), file, doing);
  checked(H5Pset_small_data_block_size(access, 0), file, doing);
  if (communicator.size() > 1) checked(H5Pset_fapl_mpio(access, communicator.handle(), MPI_INFO_NULL), file, doing);
  return access;
}

/// How values are written: by all ranks in one call where there are several.
Properties collective_transfer(const fs::path& file, const Communicator& communicator)
{
  const std::string doing = "cannot prepare writing";
  Properties transfer(checked(H5Pcreate(H5P_DATASET_XFER), file, doing));
  if (communicator.size() > 1) checked(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), file, doing);
  return transfer;
}

// These give negative ids where they fail.

/// For values without the time at which they came, so that the same run writes the same bytes.
Properties undated()
{
  Properties properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties, false);
  return properties;
}

/// For groups that know the order in which their members came, so that a file says in which order its columns are.
Properties ordered_group()
{
  Properties properties(H5Pcreate(H5P_GROUP_CREATE));
  constexpr unsigned most_in_header = 64;
  H5Pset_obj_track_times(properties, false);
  H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_link_phase_change(properties, most_in_header, most_in_header / 2);
  return properties;
}

/// Properties of links along paths whose missing groups are made.
Properties with_groups_on_the_way()
{
  Properties links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  return links;
}

/// A text of a fixed length, with a zero at its end.
Type text_type(const std::string& text)
{
  Type type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, text.size() + 1);
  return type;
}

}  // namespace

void close_nothing_at_exit()
{
  H5dont_atexit();
}

Quiet::Quiet()
{
  // Handles close themselves, so nothing is left for HDF5 to do when the program ends; and what it does then crashes
  // after a write that failed, which would hide the exit code. Must come before any other call.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Quiet::~Quiet()
{
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

hid_t Location::checked(hid_t result) const
{
  return hdf5::checked(result, file_->path, file_->doing);
}

Location Location::make_group(const std::string& path) const
{
  const Properties links = with_groups_on_the_way();
  return Location(file_, Group(checked(H5Gcreate2(id(), path.c_str(), links, ordered_group(), H5P_DEFAULT))));
}

void Location::write_attribute(const std::string& name, const std::string& text) const
{
  const Type type = text_type(text);
  write_attribute(name, {type, type}, 1, text.c_str());
}

void Location::write_attribute(const std::string& name, ElementType type, hsize_t n, const void* values) const
{
  const Space space(checked(n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr)));
  const Attribute attribute(checked(H5Acreate2(id(), name.c_str(), type.in_file, space, H5P_DEFAULT, H5P_DEFAULT)));
  checked(H5Awrite(attribute, type.in_memory, values));
}

Space Location::select(const Space& in_file, std::span<const Slab> slabs) const
{
  checked(H5Sselect_none(in_file));
  for (const Slab& slab : slabs) {
    if (std::find(slab.n.begin(), slab.n.end(), 0U) != slab.n.end()) continue;
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_OR, slab.first.data(), nullptr, slab.n.data(), nullptr));
  }
  const auto n = static_cast<hsize_t>(checked(H5Sget_select_npoints(in_file)));
  return Space(checked(H5Screate_simple(1, &n, nullptr)));
}

void Location::write(const std::string& path, const Share& share, ElementType type, const void* values) const
{
  const Space in_file(
      checked(H5Screate_simple(static_cast<int>(share.dimensions.size()), share.dimensions.data(), nullptr)));
  Dataset dataset(
      checked(H5Dcreate2(id(), path.c_str(), type.in_file, in_file, with_groups_on_the_way(), undated(), H5P_DEFAULT)));
  // Nothing to write on any rank; ranks together would fail at it.
  if (checked(H5Sget_simple_extent_npoints(in_file)) == 0) return;
  const Space in_memory = select(in_file, share.slabs);
  try {
    checked(H5Dwrite(dataset, type.in_memory, in_memory, in_file, file_->transfer, values));
    checked(dataset.close());  // small datasets go to the disk only now
  } catch (const FileError& error) {
    file_->failure = error.cause;
  }
}

void Location::write_from_first(const std::string& path, const std::vector<hsize_t>& dimensions, ElementType type,
                                const void* values) const
{
  Share share{dimensions, {}};
  if (file_->communicator.is_first()) share.slabs.push_back({std::vector<hsize_t>(dimensions.size(), 0), dimensions});
  write(path, share, type, values);
}

void Location::write_from_first(const std::string& path, const std::string& text) const
{
  const Type type = text_type(text);
  write_from_first(path, {1}, {type, type}, text.c_str());
}

void Location::remove(const std::string& path) const
{
  checked(H5Ldelete(id(), path.c_str(), H5P_DEFAULT));
}

Location Location::group(const std::string& path) const
{
  return Location(file_, Group(checked(H5Gopen2(id(), path.c_str(), H5P_DEFAULT))));
}

std::vector<std::string> Location::members(MemberOrder order) const
{
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  const H5_index_t index = order == MemberOrder::by_name ? H5_INDEX_NAME : H5_INDEX_CRT_ORDER;
  checked(H5Literate(id(), index, H5_ITER_INC, nullptr, add, &names));
  return names;
}

void Location::read_attribute(const std::string& name, ElementType type, std::size_t n, void* values) const
{
  const Attribute attribute(checked(H5Aopen(id(), name.c_str(), H5P_DEFAULT)));
  const Space space(checked(H5Aget_space(attribute)));
  if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(n)) {
    throw FileError(file_->path.string(), "has not the numbers of '" + name + "'");
  }
  checked(H5Aread(attribute, type.in_memory, values));
}

std::string Location::text_attribute(const std::string& name) const
{
  const Attribute attribute(checked(H5Aopen(id(), name.c_str(), H5P_DEFAULT)));
  const Type type(checked(H5Aget_type(attribute)));
  std::string text(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, text.data()));
  return text.substr(0, text.find('\0'));
}

DatasetInfo Location::info(const std::string& path) const
{
  const Dataset dataset(checked(H5Dopen2(id(), path.c_str(), H5P_DEFAULT)));
  const Space space(checked(H5Dget_space(dataset)));
  const Type type(checked(H5Dget_type(dataset)));
  DatasetInfo info;
  info.dimensions.resize(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space))));
  checked(H5Sget_simple_extent_dims(space, info.dimensions.data(), nullptr));
  info.whole_numbers = H5Tget_class(type) == H5T_INTEGER;
  const hsize_t n_bytes = H5Dget_storage_size(dataset);
  if (n_bytes > 0) info.end = H5Dget_offset(dataset) + n_bytes;
  return info;
}

void Location::read(const std::string& path, const Slab& box, ElementType type, void* values) const
{
  const Dataset dataset(checked(H5Dopen2(id(), path.c_str(), H5P_DEFAULT)));
  const Space in_file(checked(H5Dget_space(dataset)));
  const Space in_memory = select(in_file, std::span(&box, 1));
  checked(H5Dread(dataset, type.in_memory, in_memory, in_file, H5P_DEFAULT, values));
}

std::string Location::read_text(const std::string& path) const
{
  const Dataset dataset(checked(H5Dopen2(id(), path.c_str(), H5P_DEFAULT)));
  const Type type(checked(H5Dget_type(dataset)));
  std::string text(H5Tget_size(type), '\0');
  checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
  return text.substr(0, text.find('\0'));
}

OpenFile::OpenFile(const fs::path& file, Access access, std::string doing, const Communicator& communicator)
    : Location(std::make_shared<FileState>())
{
  file_->path = file;
  file_->doing = std::move(doing);
  file_->communicator = communicator;
  file_->transfer = collective_transfer(file, communicator);
  on_all_ranks(communicator, [&] {
    expect_no_stream(file);
    const Properties how = file_access(file, communicator);
    const unsigned flags = access == Access::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR;
    file_->id = File(hdf5::checked(H5Fopen(file.c_str(), flags, how), file, "cannot be opened"));
  });
}

Location OpenFile::make_loose_group() const
{
  return Location(file_, Group(checked(H5Gcreate_anon(id(), ordered_group(), H5P_DEFAULT))));
}

void OpenFile::link(const Location& loose_group, const std::string& path) const
{
  on_all_ranks(communicator(),
               [&] { checked(H5Olink(loose_group.id(), id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT)); });
}

void OpenFile::agree() const
{
  on_all_ranks(communicator(), [&] {
    if (!file_->failure.empty()) throw FileError(file_->path.string(), file_->failure);
  });
}

void OpenFile::flush() const
{
  on_all_ranks(communicator(), [&] { checked(H5Fflush(id(), H5F_SCOPE_GLOBAL)); });
}

void OpenFile::close() const
{
  on_all_ranks(communicator(), [&] { checked(file_->id.close()); });
}

void create_file(const fs::path& file, std::size_t n_front)
{
  const std::string doing = "cannot be created";
  expect_no_stream(file);
  const Quiet quiet;
  const Properties access = file_access(file, {});
  const Properties creation(checked(H5Pcreate(H5P_FILE_CREATE), file, doing));
  checked(H5Pset_userblock(creation, n_front), file, doing);
  File made(checked(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, access), file, doing));
  checked(made.close(), file, doing);
}

std::uintmax_t used_size(const fs::path& file)
{
  const Quiet quiet;
  const std::string doing = "has no size";
  const Properties access = file_access(file, {});
  const File opened(checked(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), file, doing));
  haddr_t size = 0;
  checked(H5Fget_eoa(opened, &size), file, doing);
  return size;
}

}  // namespace tamp::runtime::hdf5
