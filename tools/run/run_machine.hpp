#pragma once

#include <nlohmann/json.hpp>

namespace tamp::tools
{

/// The machine that a run ran on: the `host` of its first rank, `processor`, `instruction_set` and `cores` there,
/// `ranks` and `threads` of each; and the program: `version`, `commit`, `build`, `architecture` and `compiler`.
nlohmann::ordered_json run_machine(int n_ranks, int n_threads);

/// Whether a run ran on this machine.
bool is_this_machine(const nlohmann::json& run_machine);

}  // namespace tamp::tools
