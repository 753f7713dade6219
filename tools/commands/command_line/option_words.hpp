#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tamp::tools
{

/// An option or a positional argument in words, for help, man page and completion.
struct OptionWords {
  /// "--threads", or "SCENE".
  std::string name;
  /// Placeholder of its value: "N", "FILE"; empty for a flag.
  std::string value;
  bool is_repeated = false;
  bool is_required = false;
  std::string meaning;
  /// Range, default, and the options that exclude it: "1 to 1024; by default its share of the cores". May be empty.
  std::string details;
  /// The only values that may be given; empty where any may.
  std::vector<std::string> choices;

  /// The option with the placeholder of its value: "--threads N", "SCENE", "[NAME...]".
  std::string usage() const;
  /// The meaning, with the details.
  std::string description() const { return details.empty() ? meaning : meaning + " (" + details + ")"; }
  bool is_positional() const { return !name.starts_with("-"); }
};

/// Whether it takes no value.
bool is_flag(const CLI::Option& option);

/// The options of a command, positional arguments first.
std::vector<OptionWords> options_of(const CLI::App& command);

/// The commands of the program, or of a command, in the order in which they were added.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

}  // namespace tamp::tools
