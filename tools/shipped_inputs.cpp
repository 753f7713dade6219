#include "tools/shipped_inputs.hpp"

#include "runtime/file_error.hpp"

namespace tamp::tools
{

std::filesystem::path shipped_input(const std::filesystem::path& file)
{
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& inputs : {fs::path("inputs"), program / "../../inputs", program / "../share/tamp/inputs"}) {
    if (fs::exists(inputs / file, none)) return inputs / file;
  }
  throw runtime::FileError("inputs" / file, "not found here, beside the program's sources, or where it is installed");
}

}  // namespace tamp::tools
