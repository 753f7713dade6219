#pragma once

#include <CLI/CLI.hpp>

/// Checks of numbers on the command line, which say in words what they expect. None takes nan or inf.
namespace tamp::tools
{

CLI::Validator is_at_least(double least);
CLI::Validator is_above_zero();
/// Both ends belong to it.
CLI::Validator is_from_to(double least, double most);

}  // namespace tamp::tools
