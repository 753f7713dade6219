#include "tools/scene/files/output_file.hpp"

#include <span>

#include "runtime/storage/whole_file.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

namespace fs = std::filesystem;

/// The same path for all names of a file that may not be there yet.
fs::path place_of(const OutputFile& output)
{
  return fs::weakly_canonical(fs::absolute(output.file));
}

/// The output as the user knows it; one that no option asks for by its name alone.
std::string text_of(const OutputFile& output)
{
  return output.option.empty() ? output.file.string() : output.option + " " + output.file.string();
}

void expect_no_input(const OutputFile& output)
{
  if (!is_input(output.file)) return;
  throw InputError({text_of(output), "one of the files that are read", "expected another file"});
}

void expect_all(std::span<const OutputFile> outputs)
{
  for (const OutputFile& output : outputs) {
    if (output.file.empty()) continue;
    expect_no_input(output);
    for (const OutputFile& other : outputs) {
      if (&other == &output || other.file.empty() || place_of(other) != place_of(output)) continue;
      const std::string of_other = other.option.empty() ? other.file.string() : other.option;
      throw InputError({text_of(output), "the file of " + of_other, "expected another file"});
    }
    runtime::expect_writable(output.file);
  }
}

}  // namespace

void expect_outputs(std::initializer_list<OutputFile> outputs)
{
  expect_all(outputs);
}

void expect_results(const fs::path& folder, const std::vector<std::string>& names)
{
  std::vector<OutputFile> outputs;
  for (const std::string& name : names) {
    runtime::expect_no_stream(folder / name);
    outputs.push_back({"", folder / name});
  }
  expect_all(outputs);
}

void write_output(const OutputFile& output, std::string_view content)
{
  expect_no_input(output);
  runtime::write_whole_file(output.file, content);
}

}  // namespace tamp::tools
