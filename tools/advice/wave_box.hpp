#pragma once

#include <string>

#include "tasks/scene.hpp"

namespace tamp::tools
{

/// When waves from a body are at the nearest side of the ground that it goes into, and back, or how far they come by
/// the end; and the settings of a smaller grid, from whose sides none would be back in time, where it saves a fifth of
/// the cells or more.
std::string advice_on_box(const tasks::Scene& scene, const tasks::SceneBody& body, const tasks::SceneBody& ground);

}  // namespace tamp::tools
