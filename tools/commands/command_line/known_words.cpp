#include "tools/commands/command_line/known_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/commands/command_line/option_words.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/suggestion.hpp"

namespace tamp::tools
{

namespace
{

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands)
{
  std::vector<std::string> names(commands.size());
  std::transform(commands.begin(), commands.end(), names.begin(), [](const CLI::App* c) { return c->get_name(); });
  return names;
}

/// Null if there is none.
const CLI::App* find_command(const CLI::App& app, const std::string& name)
{
  for (const CLI::App* command : commands_of(app)) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

/// Finds a command below another one.
const CLI::App& command_below(const CLI::App& above, const std::string& name)
{
  if (const CLI::App* command = find_command(above, name)) return *command;
  const std::vector<std::string> known = names_of(commands_of(above));
  throw InputError(
      {name, fmt::format("no command of {}", above.get_name()),
       meant_or(name, known,
                known.empty() ? "expected none" : fmt::format("expected one of {}", fmt::join(known, ", ")))});
}

void expect_known_option(const CLI::App& command, const std::string& word)
{
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options({})) {
    for (const std::string& long_name : option->get_lnames()) known.push_back("--" + long_name);
  }
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError({name, fmt::format("no option of {}", command.get_name()),
                    meant_or(name, known, fmt::format("see tamp help {}", command.get_name()))});
}

/// Whether the word is the value of the option before it.
bool is_value(const CLI::App& command, const std::string& before)
{
  if (!before.starts_with("--") || before.find('=') != std::string::npos) return false;
  const CLI::Option* option = command.get_option_no_throw(before);
  return option != nullptr && !is_flag(*option);
}

}  // namespace

void expect_known_words(const CLI::App& app, const std::vector<std::string>& words)
{
  if (words.empty()) {
    throw InputError({"no command", "nothing to do",
                      fmt::format("expected one of {}", fmt::join(names_of(commands_of(app)), ", "))});
  }
  if (words.front().starts_with("-")) return expect_known_option(app, words.front());
  const CLI::App* command = &command_below(app, words.front());
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "--") return;
    if (is_value(*command, words[i - 1])) continue;
    if (const CLI::App* below = find_command(*command, words[i])) command = below;
    if (words[i].starts_with("--")) expect_known_option(*command, words[i]);
  }
}

const CLI::App& command_named(const CLI::App& app, const std::vector<std::string>& words)
{
  const CLI::App* command = &app;
  for (const std::string& word : words) command = &command_below(*command, word);
  return *command;
}

}  // namespace tamp::tools
