#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tamp::runtime
{

/// A table of a run's memory when it was largest, by label and by the task that makes the labels, largest first. Made
/// from a `profile.json`; throws nlohmann's exceptions for one that no run has written.
std::string memory_text(const nlohmann::json& profile);

}  // namespace tamp::runtime
