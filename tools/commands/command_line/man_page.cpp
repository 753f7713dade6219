#include "tools/commands/command_line/man_page.hpp"

#include <fmt/format.h>

#include <sstream>

#include "tools/commands/command_line/option_words.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools
{

namespace
{

/// Text in which roff sees no requests and no escapes, and whose hyphens can be copied.
std::string plain(const std::string& text)
{
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else if (c == '.' && (escaped.empty() || escaped.back() == '\n'))
      escaped += "\\&.";
    else if (c == '\'' && (escaped.empty() || escaped.back() == '\n'))
      escaped += "\\&'";
    else
      escaped += c;
  }
  return escaped;
}

/// A paragraph with a bold tag.
std::string tagged(const std::string& tag, const std::string& value, const std::string& text)
{
  const std::string after = value.empty() ? "" : fmt::format(" \\fI{}\\fR", plain(value));
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", plain(tag), after, plain(text));
}

std::string examples_of(const CLI::App& command)
{
  std::istringstream lines(command.get_footer());
  std::string text, line;
  std::getline(lines, line);  // its heading
  while (std::getline(lines, line)) text += plain(line) + "\n";
  return text.empty() ? "" : ".PP\nExamples:\n.PP\n.nf\n" + text + ".fi\n";
}

std::string section_of(const CLI::App& command, const std::string& name)
{
  std::string usage = "\\fB" + plain(name) + "\\fR";
  std::string options;
  for (const OptionWords& option : options_of(command)) {
    if (option.is_positional()) usage += " \\fI" + plain(option.usage()) + "\\fR";
    options += tagged(option.name, option.is_positional() ? "" : option.value, option.description());
  }
  std::string text = fmt::format(".SS {}\n{}\n.PP\n{}\n{}{}", plain(name), usage, plain(command.get_description()),
                                 options, examples_of(command));
  for (const CLI::App* below : commands_of(command)) text += section_of(*below, name + " " + below->get_name());
  return text;
}

}  // namespace

std::string man_page(const CLI::App& app)
{
  std::string text = fmt::format(".TH TAMP 1 \"\" \"tamp {}\" \"TAMP\"\n", plain(version()));
  text += fmt::format(".SH NAME\ntamp \\- {}\n", plain(app.get_description()));
  text += ".SH SYNOPSIS\n\\fBtamp\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] [\\fIARGUMENTS\\fR]\n.SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) text += section_of(*command, "tamp " + command->get_name());
  text += ".SH EXIT STATUS\n";
  text += tagged("0", "", "done, also with warnings");
  text += tagged("2", "", "a command line or an input that is wrong, or an input that is not there");
  text += tagged("3", "", "a simulation became unstable or invalid; or warnings, with --strict");
  text +=
      tagged("4", "", "files, memory or threads: what cannot be read, written or had, a damaged file of TAMP's own");
  text += tagged("129, 130, 143, 152", "", "stopped by SIGHUP, SIGINT, SIGTERM or SIGXCPU, with the state kept");
  return text;
}

}  // namespace tamp::tools
