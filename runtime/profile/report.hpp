#pragma once

#include <nlohmann/json.hpp>

#include "runtime/data/memory_ledger.hpp"
#include "runtime/profile/profiler.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// `profile.json`: tasks, overhead, critical path, messages, and the high-water mark of memory by label, summed over
/// the ranks. Collective.
nlohmann::json to_json(const Profile& profile, const MemoryLedger& ledger, const Communicator& communicator = {});

}  // namespace tamp::runtime
