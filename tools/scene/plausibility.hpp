#pragma once

#include <string>
#include <vector>

#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// Warnings of values that are allowed in a scene, and hardly ever meant: a line each, with its place. A table whose
/// numbers look like MPa or percent, a density of no known matter, a body faster than the fastest wave, a material that
/// no body is of, and particles whose mass is not their solid's.
std::vector<std::string> plausibility_warnings(const CheckedScene& checked);

/// Where a scene takes a material for another one than was tested: a line each, with its place. A density more than 5 %
/// from that of the samples, and measured strains that are read as others. A report's scene may mean it, so that a run
/// does not say it again.
std::vector<std::string> material_warnings(const CheckedScene& checked);

}  // namespace tamp::tools
