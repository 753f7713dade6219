#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>

#include "runtime/data/memory_ledger.hpp"
#include "runtime/profile/profiler.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// `profile.json`: tasks, overhead, critical path, messages, and the high-water mark of memory by label, summed over
/// the ranks. Collective.
nlohmann::json to_json(const Profile& profile, const MemoryLedger& ledger, const Communicator& communicator = {});

/// Writes the trace in the Chrome / Perfetto event format, one track for each worker of each rank, piece by piece: as a
/// whole it may be larger than all else that a run keeps in memory.
void write_trace(const Trace& trace, const std::function<void(std::string_view)>& write);

}  // namespace tamp::runtime
