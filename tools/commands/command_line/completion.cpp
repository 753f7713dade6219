#include "tools/commands/command_line/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "tools/commands/command_line/option_words.hpp"

namespace tamp::tools
{

namespace
{

std::vector<std::string> names_below(const CLI::App& app)
{
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

/// Words that may come next in a command, besides files.
std::vector<std::string> words_of(const CLI::App& command)
{
  std::vector<std::string> words = names_below(command);
  for (const OptionWords& option : options_of(command)) {
    if (option.is_positional())
      words.insert(words.end(), option.choices.begin(), option.choices.end());
    else
      words.push_back(option.name);
  }
  return words;
}

std::string bash_cases(const CLI::App& command, const std::string& path)
{
  std::string cases = fmt::format("    '{}') words='{}' ;;\n", path, fmt::join(words_of(command), " "));
  for (const CLI::App* below : commands_of(command)) {
    cases += bash_cases(*below, path.empty() ? below->get_name() : path + " " + below->get_name());
  }
  return cases;
}

/// The values of options that have only a few, and those that take a file or a folder.
std::string bash_values(const CLI::App& command, const std::string& path)
{
  std::string cases;
  for (const OptionWords& option : options_of(command)) {
    if (option.is_positional() || option.value.empty()) continue;
    cases += option.choices.empty()
                 ? fmt::format("    '{} {}') COMPREPLY=($(compgen -f -- \"$word\")); return ;;\n", path, option.name)
                 : fmt::format("    '{} {}') COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n", path,
                               option.name, fmt::join(option.choices, " "));
  }
  for (const CLI::App* below : commands_of(command)) {
    cases += bash_values(*below, path.empty() ? below->get_name() : path + " " + below->get_name());
  }
  return cases;
}

/// In single quotes of zsh, for the lists of _describe and _arguments.
std::string zsh_text(const std::string& text)
{
  std::string escaped;
  for (const char c : text) {
    if (c == '\'')
      escaped += "'\\''";
    else if (c == ':' || c == '[' || c == ']' || c == '\\')
      escaped += std::string("\\") + c;
    else
      escaped += c;
  }
  return escaped;
}

std::string zsh_option(const OptionWords& option)
{
  const std::string action = option.choices.empty() ? "_files" : fmt::format("({})", fmt::join(option.choices, " "));
  if (option.is_positional()) {
    return fmt::format("'{}:{}:{}'", option.is_repeated ? "*" : "", zsh_text(option.name), action);
  }
  return fmt::format("'{}{}[{}]{}'", option.is_repeated ? "*" : "", option.name, zsh_text(option.meaning),
                     option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), action));
}

std::string zsh_commands(const CLI::App& app)
{
  std::string list;
  for (const CLI::App* command : commands_of(app)) {
    list += fmt::format(" '{}:{}'", command->get_name(), zsh_text(command->get_description()));
  }
  return list;
}

std::string zsh_cases(const CLI::App& app)
{
  std::string cases;
  for (const CLI::App* command : commands_of(app)) {
    cases += fmt::format("    {})\n      _arguments", command->get_name());
    for (const OptionWords& option : options_of(*command)) cases += " \\\n        " + zsh_option(option);
    cases += " ;;\n";
  }
  return cases;
}

}  // namespace

std::string bash_completion(const CLI::App& app)
{
  return fmt::format(R"(# bash completion of tamp
_tamp()
{{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} path='' words='' i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$path ${{COMP_WORDS[i]}}" in
{}    esac
  done
  case "$path $before" in
{}  esac
  case "$path" in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  [[ $word == -* || -z $path ]] || COMPREPLY+=($(compgen -f -- "$word"))
}}
complete -o filenames -F _tamp tamp
)",
                     [&] {
                       std::string steps;
                       for (const CLI::App* command : commands_of(app)) {
                         steps += fmt::format("      ' {0}') path='{0}' ;;\n", command->get_name());
                         for (const CLI::App* below : commands_of(*command)) {
                           steps += fmt::format("      '{0} {1}') path='{0} {1}' ;;\n", command->get_name(),
                                                below->get_name());
                         }
                       }
                       return steps;
                     }(),
                     bash_values(app, ""), bash_cases(app, ""));
}

std::string zsh_completion(const CLI::App& app)
{
  return fmt::format(R"(#compdef tamp
# zsh completion of tamp
_tamp()
{{
  local -a commands
  commands=({})
  if (( CURRENT == 2 )); then
    _describe 'command' commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
if [[ $funcstack[1] == _tamp ]]; then _tamp "$@"; else compdef _tamp tamp; fi
)",
                     zsh_commands(app), zsh_cases(app));
}

}  // namespace tamp::tools
