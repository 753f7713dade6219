#pragma once

#include <CLI/CLI.hpp>

namespace tamp::tools
{

/// For an option that names something: what a shell makes of a variable that is not set is no name.
inline CLI::Validator not_empty()
{
  return {[](const std::string& value) -> std::string { return value.empty() ? "nothing; expected a name" : ""; }, ""};
}

}  // namespace tamp::tools
