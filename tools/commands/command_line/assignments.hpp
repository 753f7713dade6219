#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tamp::tools
{

/// Adds --set to a command that reads a scene, a material or the like: `what`.
inline void add_assignments(CLI::App& command, std::vector<std::string>& assignments, const std::string& what)
{
  command.add_option("--set", assignments, "replace a value of the " + what + ", may be repeated")
      ->type_name("POINTER=VALUE")
      ->allow_extra_args(false);
}

}  // namespace tamp::tools
