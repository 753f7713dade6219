#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tamp::tools
{

/// The word that was meant, as far as that can be told: the one that takes fewest letters to change, if these are few.
std::optional<std::string> closest(const std::string& word, const std::vector<std::string>& known);

/// Throws InputError if the command line has no command, or a command or an option that there is not. That is said
/// before anything that is missing.
void expect_known_words(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace tamp::tools
