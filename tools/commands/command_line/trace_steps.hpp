#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "runtime/profile/trace_choice.hpp"

namespace tamp::tools
{

/// Reads a choice of steps: how many of the first (0: none), FIRST:LAST, which are both in it, slowest, or none. Throws
/// std::invalid_argument with what was found and expected.
runtime::TraceChoice trace_choice(const std::string& text);

/// Accepts texts that are such a choice.
CLI::Validator is_trace_choice();

}  // namespace tamp::tools
