#pragma once

#include <nlohmann/json.hpp>

namespace tamp::runtime
{

/// Throws std::out_of_range for a `profile.json` with numbers that no run comes to: negative times, those that no clock
/// has counted, patches and ranks that are none of the run's. What is missing, or of another kind, who reads it finds.
void check_profile(const nlohmann::json& profile);

}  // namespace tamp::runtime
