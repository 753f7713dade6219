#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "runtime/data/memory_ledger.hpp"
#include "runtime/profile/profiler.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// `profile.json`: tasks, overhead, critical path, messages, and the high-water mark of memory by label, summed over
/// the ranks. Collective.
nlohmann::json to_json(const Profile& profile, const MemoryLedger& ledger, const Communicator& communicator = {});

/// The trace in the Chrome / Perfetto event format: one track for each worker of each rank.
nlohmann::json trace_to_json(const Profile& profile);

/// A table of a `profile.json`, most expensive task first; at most `n_rows` rows when positive.
std::string to_text(const nlohmann::json& profile, int n_rows = 0);

}  // namespace tamp::runtime
