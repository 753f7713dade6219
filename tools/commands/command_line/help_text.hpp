#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

namespace tamp::tools
{

/// An example of a command line, and what it does.
struct Example {
  std::string command;
  std::string meaning;
};

/// The end of a command's help.
std::string examples(std::initializer_list<Example> all);

/// Help as people read it: what a value may be in words, lines that fit on a screen of 80 columns.
class HelpFormatter : public CLI::Formatter
{
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace tamp::tools
