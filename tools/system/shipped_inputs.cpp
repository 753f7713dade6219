#include "tools/system/shipped_inputs.hpp"

#include "runtime/file_error.hpp"

namespace tamp::tools
{

namespace fs = std::filesystem;

namespace
{

fs::path folder_of_program()
{
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none).parent_path();
}

fs::path first_with(const fs::path& file, const std::vector<fs::path>& folders)
{
  std::error_code none;
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / file, none)) return folder / file;
  }
  return {};
}

}  // namespace

std::vector<fs::path> input_folders()
{
  const fs::path program = folder_of_program();
  return {"inputs", program / "../../inputs", program / "../share/tamp/inputs"};
}

fs::path shipped_input(const fs::path& file)
{
  const fs::path found = first_with(file, input_folders());
  if (!found.empty()) return found;
  throw runtime::FileError("inputs" / file, "not found here, beside the program's sources, or where it is installed");
}

fs::path shipped_python_tools()
{
  const fs::path program = folder_of_program();
  const fs::path found = first_with("tamp", {program / "../../tools/python", program / "../share/tamp/python"});
  if (!found.empty()) return fs::weakly_canonical(found);
  throw runtime::FileError("tools/python/tamp", "not found beside the program's sources, or where it is installed");
}

}  // namespace tamp::tools
