#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tamp::tools
{

/// The manual page of the program, in the man macros of roff, made from what the parser knows.
std::string man_page(const CLI::App& app);

}  // namespace tamp::tools
