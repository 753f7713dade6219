#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tamp::tools
{

/// Throws InputError if the command line has no command, or a command or an option that there is not. That is said
/// before anything that is missing.
void expect_known_words(const CLI::App& app, const std::vector<std::string>& words);

/// The command that these words lead to, one below the other; the program where there are none. Throws InputError for a
/// word that leads to none.
const CLI::App& command_named(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace tamp::tools
