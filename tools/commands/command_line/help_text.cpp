#include "tools/commands/command_line/help_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/commands/command_line/option_words.hpp"

namespace tamp::tools
{

namespace
{

constexpr std::size_t n_columns = 80;

/// Words in lines; the first goes on at column `at`, the others begin at `indent`.
std::string wrapped(const std::string& text, std::size_t at, std::size_t indent)
{
  std::string lines;
  std::size_t column = at;
  for (const std::string& word : CLI::detail::split(text, ' ')) {
    const bool begins = column <= indent;
    if (!begins && column + 1 + word.size() > n_columns) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!begins) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

/// A name, and its meaning from a common column on.
std::string entry(const std::string& name, const std::string& meaning)
{
  constexpr std::size_t indent = 26;
  std::string line = "  " + name;
  if (line.size() + 2 > indent)
    line += "\n" + std::string(indent, ' ');
  else
    line.resize(indent, ' ');
  return line + wrapped(meaning, indent, indent) + "\n";
}

std::string usage_of(const CLI::App& app)
{
  std::string name = app.get_name();
  for (const CLI::App* above = app.get_parent(); above != nullptr; above = above->get_parent()) {
    name.insert(0, above->get_name() + " ");
  }
  std::string usage = "Usage: " + name;
  const auto commands = commands_of(app);
  if (!commands.empty()) usage += app.get_require_subcommand_min() > 0 ? " COMMAND" : " [COMMAND]";
  usage += " [OPTIONS]";
  for (const OptionWords& option : options_of(app)) {
    if (option.is_positional()) usage += " " + option.usage();
  }
  return usage;
}

}  // namespace

std::string examples(std::initializer_list<Example> all)
{
  std::string text = "Examples:\n";
  for (const Example& example : all) {
    text += fmt::format("  {}\n      {}\n", example.command, wrapped(example.meaning, 6, 6));
  }
  return text;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string /*name*/, CLI::AppFormatMode /*mode*/) const
{
  std::string text = wrapped(app->get_description(), 0, 0) + "\n\n" + usage_of(*app) + "\n";
  std::string positionals, options, commands;
  for (const OptionWords& option : options_of(*app)) {
    (option.is_positional() ? positionals : options) += entry(option.usage(), option.description());
  }
  for (const CLI::App* command : commands_of(*app)) commands += entry(command->get_name(), command->get_description());
  if (!commands.empty()) text += "\nCommands:\n" + commands;
  if (!positionals.empty()) text += "\nArguments:\n" + positionals;
  if (!options.empty()) text += "\nOptions:\n" + options;
  if (!app->get_footer().empty()) text += "\n" + app->get_footer();
  return text;
}

}  // namespace tamp::tools
