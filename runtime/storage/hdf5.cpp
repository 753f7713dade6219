#include "runtime/storage/hdf5.hpp"

#include "runtime/storage/file_error.hpp"

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

}  // namespace tamp::runtime::hdf5
