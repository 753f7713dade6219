#include "tools/system/charts.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "runtime/file_error.hpp"
#include "tools/system/child_process.hpp"
#include "tools/system/shell_word.hpp"
#include "tools/system/shipped_inputs.hpp"

namespace tamp::tools
{

namespace
{

/// Debian's, for which it has matplotlib.
constexpr const char* usual_interpreter = "/usr/bin/python3";
/// Exit code of the Python tools where the interpreter has no matplotlib; see tools/python/tamp/failure.py.
constexpr int no_matplotlib = 3;
/// Exit code of a child whose program is missing.
constexpr int not_started = 127;

std::vector<std::string> interpreters()
{
  const char* chosen = std::getenv("TAMP_PYTHON");
  if (chosen != nullptr && *chosen != '\0') return {chosen};
  return {usual_interpreter, "python3"};
}

}  // namespace

void draw_page(const std::filesystem::path& folder)
{
  const std::string tools = shipped_python_tools().string();
  for (const std::string& interpreter : interpreters()) {
    const int code = run_child({{tools, "draw", folder.string()}, "", interpreter}).exit_code;
    if (code == 0) return;
    if (code == not_started || code == no_matplotlib) continue;
    throw runtime::FileError(folder.string(), fmt::format("its figures are written, but could not be drawn; to try "
                                                          "again: {} {} draw {}",
                                                          interpreter, shell_word(tools), shell_word(folder.string())));
  }
  throw runtime::FileError(folder.string(),
                           fmt::format("its figures are written, but not drawn, for want of Python with matplotlib "
                                       "(Debian: python3-matplotlib; TAMP_PYTHON names another interpreter); to draw "
                                       "them later: {} {} draw {}",
                                       usual_interpreter, shell_word(tools), shell_word(folder.string())));
}

}  // namespace tamp::tools
