#pragma once

#include <string>
#include <vector>

#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// What is allowed in a scene, and is hardly ever meant: a line each, with its place. A table whose numbers look like
/// MPa or percent, a density of no known matter, a body faster than the fastest wave, a material that no body is of,
/// and particles whose mass is not their solid's.
std::vector<std::string> plausibility_warnings(const CheckedScene& checked);

}  // namespace tamp::tools
