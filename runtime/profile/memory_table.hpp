#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tamp::runtime
{

/// What a run's memory was for when it was at its most, by label and by the task that makes the labels, largest first.
/// Of a `profile.json`; throws nlohmann's exceptions for what no run has written.
std::string memory_text(const nlohmann::json& profile);

}  // namespace tamp::runtime
