#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tamp::tools
{

/// A script that lets bash complete the program's commands, options and values. Where none is known, files are offered.
std::string bash_completion(const CLI::App& app);

/// Completion for zsh, with the meaning of each command and option.
std::string zsh_completion(const CLI::App& app);

}  // namespace tamp::tools
