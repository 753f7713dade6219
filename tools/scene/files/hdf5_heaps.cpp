#include "tools/scene/files/hdf5_heaps.hpp"

#include <cstdint>
#include <cstring>
#include <map>
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

/// By number; empty if the objects do not lie one behind another until the heap's end.
std::map<std::uint32_t, std::uint64_t> sizes_of_objects(std::string_view heap)
{
  std::map<std::uint32_t, std::uint64_t> sizes;
  std::size_t at = header_bytes;
  while (at + header_bytes <= heap.size()) {
    const std::uint64_t room = room_of_object(heap, at);
    if (room == 0 || room > heap.size() - at) return {};
    sizes[number_at<std::uint16_t>(heap, at)] = number_at<std::uint64_t>(heap, at + size_at);
    at += room;
  }
  return sizes;
}

/// A text of an attribute is its length, the place of its heap in the file and its number there. HDF5 takes as much
/// memory as the length says before it looks into the heap.
bool has_texts_beyond_their_objects(std::string_view bytes, std::uint64_t heap,
                                    const std::map<std::uint32_t, std::uint64_t>& sizes)
{
  constexpr std::size_t length_bytes = sizeof(std::uint32_t), place_bytes = sizeof heap;
  std::string place(place_bytes, '\0');
  std::memcpy(place.data(), &heap, place_bytes);
  for (std::size_t at = bytes.find(place, length_bytes); at != bytes.npos; at = bytes.find(place, at + 1)) {
    if (at + place_bytes + sizeof(std::uint32_t) > bytes.size()) return false;
    const auto object = sizes.find(number_at<std::uint32_t>(bytes, at + place_bytes));
    if (object == sizes.end() || object->first == 0) continue;
    if (number_at<std::uint32_t>(bytes, at - length_bytes) > object->second) return true;
  }
  return false;
}

}  // namespace

void expect_sound_heaps(const std::filesystem::path& file)
{
  const std::string content = read_input_file(file);
  const std::string_view bytes = content;
  for (std::size_t at = bytes.find(signature); at != bytes.npos; at = bytes.find(signature, at + 1)) {
    if (at + header_bytes > bytes.size()) return;
    const auto size = number_at<std::uint64_t>(bytes, at + size_at);
    const auto sizes = sizes_of_objects(bytes.substr(at, size));
    if (!sizes.empty() && !has_texts_beyond_their_objects(bytes, at, sizes)) continue;
    throw InputError({file.string(), "an HDF5 file whose texts are damaged", "expected an HDF5 file"});
  }
}

}  // namespace tamp::tools
