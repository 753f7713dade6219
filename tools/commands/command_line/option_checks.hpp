#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

/// Checks of what is on the command line, which say in words what they expect. No number may be nan or inf.
namespace tamp::tools
{

/// A whole number that fits.
CLI::Validator is_whole_from(std::int64_t least);
/// A whole number from `least` to `most`, both of which belong to it.
CLI::Validator is_whole_from_to(std::int64_t least, std::int64_t most);
CLI::Validator is_above_zero();
CLI::Validator is_at_least_zero();
/// Both ends belong to it.
CLI::Validator is_from_to(double least, double most);

CLI::Validator is_one_of(const std::vector<std::string>& choices);
/// A name: what a shell makes of a variable that is not set is none.
CLI::Validator is_not_empty();

}  // namespace tamp::tools
