#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>

#include "runtime/profile/trace.hpp"

namespace tamp::runtime
{

/// Writes a trace, and what is told about it with `about`, an object, in the trace-event format of Chrome and Perfetto,
/// as one JSON object, piece by piece: as a whole it may be larger than all else that a run keeps in memory.
///
/// Each rank is a process. Its tracks are the steps, its workers, and as many of messages as were on their way at once.
/// An arrow leads to a task from the predecessor that was done last, and from what sent a message to what received it.
void write_trace(const Trace& trace, const std::function<void(std::string_view)>& write,
                 const nlohmann::ordered_json& about = nlohmann::ordered_json::object());

}  // namespace tamp::runtime
