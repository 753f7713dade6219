#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/engine.hpp"

namespace tamp::tools
{

/// The steps that a program has run of a simulation: none if `last` is less than `first`.
struct StepsRun {
  long first = 1;
  long last = 0;
};

/// Writes `trace.json`, of the steps that the engine was asked to trace, with what the run ran on. Throws FileError.
/// Collective.
///
/// Returns a line for the user, on the first rank, if steps of a range are missing from it; empty otherwise.
std::string write_trace(const runtime::Engine& engine, const runtime::TraceChoice& choice, const StepsRun& run,
                        const nlohmann::ordered_json& machine, const std::filesystem::path& folder);

}  // namespace tamp::tools
