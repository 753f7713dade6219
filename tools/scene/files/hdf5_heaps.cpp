#include "tools/scene/files/hdf5_heaps.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "tools/scene/files/input_file.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

/// How a heap begins, with its version; its size stands behind three bytes more.
constexpr std::string_view signature("GCOL\x01", 5);
constexpr std::size_t size_at = 8, header_bytes = 16;

template <class Number>
Number number_at(std::string_view bytes, std::size_t at)
{
  Number number{};
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// With its header; the object of number 0 is what is left of the heap, and its size counts the header. 0 of one that
/// is larger than the heap.
std::uint64_t room_of_object(std::string_view heap, std::size_t at)
{
  const auto size = number_at<std::uint64_t>(heap, at + size_at);
  if (size > heap.size()) return 0;
  if (number_at<std::uint16_t>(heap, at) == 0) return size;
  return header_bytes + ((size + 7) & ~std::uint64_t{7});
}

bool ends(std::string_view heap)
{
  std::size_t at = header_bytes;
  while (at + header_bytes <= heap.size()) {
    const std::uint64_t room = room_of_object(heap, at);
    if (room == 0 || room > heap.size() - at) return false;
    at += room;
  }
  return true;
}

}  // namespace

void expect_heaps_that_end(const std::filesystem::path& file)
{
  const std::string content = read_input_file(file);
  const std::string_view bytes = content;
  for (std::size_t at = bytes.find(signature); at != bytes.npos; at = bytes.find(signature, at + 1)) {
    if (at + header_bytes > bytes.size()) return;
    const auto size = number_at<std::uint64_t>(bytes, at + size_at);
    if (ends(bytes.substr(at, size))) continue;
    throw InputError({file.string(), "an HDF5 file whose texts are damaged", "expected an HDF5 file"});
  }
}

}  // namespace tamp::tools
