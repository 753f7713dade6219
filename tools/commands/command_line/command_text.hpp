#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tamp::tools
{

/// The command line that a command was called with, as a shell takes it, without some of its options.
std::string command_text(const CLI::App& command, const std::vector<const CLI::Option*>& without);

}  // namespace tamp::tools
