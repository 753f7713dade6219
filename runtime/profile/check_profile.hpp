#pragma once

#include <nlohmann/json.hpp>

namespace tamp::runtime
{

/// Throws std::out_of_range for a `profile.json` with numbers that no run comes to: negative times, times that no clock
/// has counted, patches and ranks that the run does not have. Entries that are missing or of another kind are left to
/// the functions that read them.
void check_profile(const nlohmann::json& profile);

}  // namespace tamp::runtime
