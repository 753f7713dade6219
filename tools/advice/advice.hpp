#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/forecast/pace.hpp"
#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// Advice on what a scene has too much or too little of: a line each, with a number. docs/reference/advice.md says what
/// each line means and where its numbers come from. Where nobody has measured what a line would say, it says so. `pace`
/// is the forecast of the scene as it is.
std::vector<std::string> advice(const CheckedScene& checked, const std::optional<tasks::Pace>& pace);

}  // namespace tamp::tools
