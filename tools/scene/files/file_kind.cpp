#include "tools/scene/files/file_kind.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include "tools/scene/files/input_file.hpp"

namespace tamp::tools
{

FileKind file_kind(const std::filesystem::path& file)
{
  expect_input_file(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string ending = file.extension().string();
  if (ending == ".json") return FileKind::json;
  if (ending == ".h5" || ending == ".hdf5" || ending == ".keras") return FileKind::hdf5;

  std::array<char, 64> buffer{};
  stream.read(buffer.data(), buffer.size());
  const std::string_view start = without_byte_order_mark({buffer.data(), static_cast<std::size_t>(stream.gcount())});
  if (start.starts_with("\x89HDF\r\n\x1a\n")) return FileKind::hdf5;
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && start[first] == '{' ? FileKind::json : FileKind::text;
}

}  // namespace tamp::tools
