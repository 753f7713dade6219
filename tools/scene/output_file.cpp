#include "tools/scene/output_file.hpp"

#include "runtime/storage/whole_file.hpp"
#include "tools/scene/input_file.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

namespace fs = std::filesystem;

/// One path for all names of a file that may not be there yet.
fs::path place_of(const OutputFile& output)
{
  return fs::weakly_canonical(fs::absolute(output.file));
}

}  // namespace

void expect_outputs(std::initializer_list<OutputFile> outputs)
{
  for (const OutputFile& output : outputs) {
    if (output.file.empty()) continue;
    if (is_input(output.file)) {
      throw InputError(
          {output.option + " " + output.file.string(), "one of the files that are read", "expected another file"});
    }
    for (const OutputFile& other : outputs) {
      if (other.option == output.option || other.file.empty()) continue;
      if (place_of(other) != place_of(output)) continue;
      throw InputError(
          {output.option + " " + output.file.string(), "the file of " + other.option, "expected another file"});
    }
    runtime::expect_writable(output.file);
  }
}

}  // namespace tamp::tools
