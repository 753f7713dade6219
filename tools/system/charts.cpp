#include "tools/system/charts.hpp"

#include <cstdlib>
#include <fstream>
#include <optional>
#include <utility>

#include "runtime/file_error.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tools/system/child_process.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
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
/// Exit codes of theirs for an input that is wrong, and for a file that is damaged or cannot be read or written.
constexpr int input_refused = 2, file_failed = 4;
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

/// How a call of the tools ended, and by which interpreter.
struct CallEnd {
  int exit_code;
  std::string interpreter;
};

/// By the first interpreter that has matplotlib; none where none has. What the tools say goes to the file `errors`, or,
/// where that is empty, to stderr.
std::optional<CallEnd> call_tools(const std::string& tools, const std::vector<std::string>& words,
                                  const std::filesystem::path& errors)
{
  std::vector<std::string> arguments{tools};
  arguments.insert(arguments.end(), words.begin(), words.end());
  for (const std::string& interpreter : interpreters()) {
    const int code = run_child({arguments, errors, interpreter}).exit_code;
    if (code != not_started && code != no_matplotlib) return CallEnd{code, interpreter};
  }
  return std::nullopt;
}

/// The lines that the tools have said, without their name.
std::vector<std::string> lines_of(const std::filesystem::path& errors)
{
  const std::string name = "python3 tools/python/tamp: ";
  std::ifstream stream(errors);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line.starts_with(name) ? line.substr(name.size()) : line);
  }
  return lines;
}

/// The place that a message begins with, and the rest of it.
std::pair<std::string, std::string> place_and_rest(const std::string& message)
{
  const std::size_t colon = message.find(": ");
  if (colon == std::string::npos) return {"the Python tools", message};
  return {message.substr(0, colon), message.substr(colon + 2)};
}

}  // namespace

void draw(const Drawing& drawing)
{
  const std::string tools = shipped_python_tools().string();
  const std::optional<CallEnd> end = call_tools(tools, drawing.words, "");
  if (end && end->exit_code == 0) return;
  if (end) {
    throw runtime::FileError(drawing.place.string(), "its figures are written, but could not be drawn; to try again: " +
                                                         command_line(end->interpreter, tools, drawing.later));
  }
  throw runtime::FileError(drawing.place.string(),
                           "its figures are written, but not drawn, for want of Python with matplotlib (Debian: "
                           "python3-matplotlib; TAMP_PYTHON names another interpreter); to draw them later: " +
                               command_line(usual_interpreter, tools, drawing.later));
}

void draw_from_inputs(const std::vector<std::string>& words, const std::filesystem::path& picture)
{
  const std::string tools = shipped_python_tools().string();
  const runtime::TemporaryFolder aside;
  const std::filesystem::path errors = aside.path() / "errors";
  const std::optional<CallEnd> end = call_tools(tools, words, errors);
  if (!end) {
    throw runtime::FileError(picture.string(),
                             "not drawn, for want of Python with matplotlib (Debian: python3-matplotlib; TAMP_PYTHON "
                             "names another interpreter)");
  }
  std::vector<std::string> said = lines_of(errors);
  const bool is_told = !said.empty() && (end->exit_code == input_refused || end->exit_code == file_failed);
  const std::string last = is_told ? said.back() : "";
  if (is_told) said.pop_back();
  for (const std::string& line : said) print_err("tamp: {}\n", line);
  if (end->exit_code == 0) return;
  if (!is_told) {
    throw runtime::FileError(picture.string(),
                             "could not be drawn; to try again: " + command_line(end->interpreter, tools, words));
  }
  const auto [place, rest] = place_and_rest(last);
  if (end->exit_code == input_refused) throw InputError({place, rest, ""});
  throw runtime::FileError(place, rest);
}

void draw_page(const std::filesystem::path& folder)
{
  const std::vector<std::string> words{"draw", folder.string()};
  draw({words, words, folder});
}

}  // namespace tamp::tools
