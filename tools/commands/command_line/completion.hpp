#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tamp::tools
{

/// A script that lets bash complete the program's commands, options and values. Where none is known, files are offered.
std::string bash_completion(const CLI::App& app);

/// The same for zsh, with what each command and option is for.
std::string zsh_completion(const CLI::App& app);

}  // namespace tamp::tools
