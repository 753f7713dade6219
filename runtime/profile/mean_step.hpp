#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "runtime/profile/profile.hpp"
#include "runtime/profile/replay.hpp"

namespace tamp::runtime
{

/// The mean step as a profile keeps it: by task, for each of its instances the patch, the group, the rank, how long it
/// takes [s], and how long the message that it receives was on its way [s].
nlohmann::json to_json(const std::vector<InstanceTime>& mean_step);

/// A step of a graph, with the times in the mean step of a `profile.json`. Instances are matched by their task, patch
/// and group, or rank; empty unless the profile has each of them, and no others but the engine's own. Throws nlohmann's
/// exceptions and std::out_of_range for a profile that no run has written.
std::optional<TimedStep> timed_step(const TaskGraph& graph, const nlohmann::json& profile);

}  // namespace tamp::runtime
