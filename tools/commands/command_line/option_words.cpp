#include "tools/commands/command_line/option_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tamp::tools
{

namespace
{

/// CLI11 has the type and what each check says of itself, with colons between: "INT:1 to 1024", "TEXT:{dot,json}".
std::vector<std::string> parts_of_type(const CLI::Option& option)
{
  return CLI::detail::split(option.get_type_name(), ':');
}

std::string value_of(const CLI::Option& option)
{
  if (is_flag(option)) return "";
  const std::string type = option.get_option_text().empty() ? parts_of_type(option).front() : option.get_option_text();
  return type == "INT" || type == "UINT" ? "N" : type == "FLOAT" ? "X" : type;
}

std::vector<std::string> choices_of(const CLI::Option& option)
{
  for (const std::string& part : parts_of_type(option)) {
    if (part.starts_with("{")) return CLI::detail::split(part.substr(1, part.size() - 2), ',');
  }
  return {};
}

std::string details_of(const CLI::Option& option)
{
  std::vector<std::string> details;
  const std::vector<std::string> parts = parts_of_type(option);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (!parts[i].empty() && parts[i] != "FILE" && !parts[i].starts_with("{")) details.push_back(parts[i]);
  }
  if (const auto choices = choices_of(option); !choices.empty()) {
    details.push_back(fmt::format("{}", fmt::join(choices, ", ")));
  }
  const std::string by_default = option.get_default_str();
  const bool is_told = option.get_description().find("by default") != std::string::npos;
  if (!is_told && !by_default.empty() && by_default != "[]" && !value_of(option).empty()) {
    details.push_back("by default " + by_default);
  }
  for (const CLI::Option* other : option.get_excludes()) details.push_back("not with " + other->get_name());
  for (const CLI::Option* other : option.get_needs()) details.push_back("only with " + other->get_name());
  return fmt::format("{}", fmt::join(details, "; "));
}

/// A text of its own where it holds words of several kinds, such as "RUN... X Y".
std::string name_of_positional(const CLI::Option& option)
{
  return option.get_option_text().empty() ? option.get_name(true) : option.get_option_text();
}

OptionWords words_of(const CLI::Option& option)
{
  return {option.get_positional()       ? name_of_positional(option)
          : option.get_lnames().empty() ? "-" + option.get_snames().front()
                                        : "--" + option.get_lnames().front(),
          value_of(option),
          option.get_expected_max() > 1,
          option.get_required(),
          option.get_description(),
          details_of(option),
          choices_of(option)};
}

}  // namespace

bool is_flag(const CLI::Option& option)
{
  return option.get_expected_min() == 0 || option.get_type_size() == 0;
}

std::string OptionWords::usage() const
{
  if (is_positional()) {
    const bool has_dots = name.find("...") != std::string::npos;
    const std::string text = name + (is_repeated && !has_dots ? "..." : "");
    return is_required ? text : "[" + text + "]";
  }
  return value.empty() ? name : name + " " + value;
}

std::vector<OptionWords> options_of(const CLI::App& command)
{
  std::vector<OptionWords> words;
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : command.get_options({})) {
      if (option->get_positional() == positional) words.push_back(words_of(*option));
    }
  }
  return words;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app)
{
  return app.get_subcommands(std::function<bool(const CLI::App*)>{});
}

}  // namespace tamp::tools
