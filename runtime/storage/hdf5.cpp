#include "runtime/storage/hdf5.hpp"

#include "runtime/file_error.hpp"

namespace tamp::runtime::hdf5
{

namespace
{

/// HDF5's error stack, seen from the call that was made towards what failed inside of it.
struct Cause {
  std::string outermost;
  /// What the system said, such as "No space left on device".
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

hid_t checked(hid_t result, const std::filesystem::path& file, const std::string& doing)
{
  if (result >= 0) return result;
  Cause cause;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, take, &cause);
  throw FileError(file.string(), doing + ": " + (cause.of_system.empty() ? cause.outermost : cause.of_system));
}

Properties file_access(const Communicator& communicator, const std::filesystem::path& file)
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

Properties collective_transfer(const Communicator& communicator, const std::filesystem::path& file)
{
  const std::string doing = "cannot prepare writing";
  Properties transfer(checked(H5Pcreate(H5P_DATASET_XFER), file, doing));
  if (communicator.size() > 1) checked(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), file, doing);
  return transfer;
}

herr_t select(hid_t space, std::span<const Slab> slabs)
{
  if (H5Sselect_none(space) < 0) return -1;
  for (const Slab& slab : slabs) {
    if (H5Sselect_hyperslab(space, H5S_SELECT_OR, slab.first.data(), nullptr, slab.n.data(), nullptr) < 0) return -1;
  }
  return 0;
}

std::uintmax_t used_size(const std::filesystem::path& file)
{
  const std::string doing = "has no size";
  const Properties access = file_access({}, file);
  const File opened(checked(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), file, doing));
  haddr_t size = 0;
  checked(H5Fget_eoa(opened, &size), file, doing);
  return size;
}

}  // namespace tamp::runtime::hdf5
