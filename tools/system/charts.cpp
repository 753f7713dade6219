#include "tools/system/charts.hpp"

#include <cstdlib>

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

/// As a shell takes it.
std::string command_line(const std::string& interpreter, const std::string& tools,
                         const std::vector<std::string>& words)
{
  std::string line = interpreter + " " + shell_word(tools);
  for (const std::string& word : words) line += " " + shell_word(word);
  return line;
}

}  // namespace

void draw(const Drawing& drawing)
{
  const std::string tools = shipped_python_tools().string();
  std::vector<std::string> arguments{tools};
  arguments.insert(arguments.end(), drawing.words.begin(), drawing.words.end());
  for (const std::string& interpreter : interpreters()) {
    const int code = run_child({arguments, "", interpreter}).exit_code;
    if (code == 0) return;
    if (code == not_started || code == no_matplotlib) continue;
    throw runtime::FileError(drawing.place.string(), "its figures are written, but could not be drawn; to try again: " +
                                                         command_line(interpreter, tools, drawing.later));
  }
  throw runtime::FileError(drawing.place.string(),
                           "its figures are written, but not drawn, for want of Python with matplotlib (Debian: "
                           "python3-matplotlib; TAMP_PYTHON names another interpreter); to draw them later: " +
                               command_line(usual_interpreter, tools, drawing.later));
}

void draw_page(const std::filesystem::path& folder)
{
  const std::vector<std::string> words{"draw", folder.string()};
  draw({words, words, folder});
}

}  // namespace tamp::tools
