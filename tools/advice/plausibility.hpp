#pragma once

#include <string>
#include <vector>

#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// Warnings of values that are allowed in a scene, and hardly ever meant: a line each, with its place. What reading it
/// has found (CheckedScene), a table whose numbers look like MPa or percent, soil whose numbers look like kPa, radians
/// or t/m3, a density of no known matter, a body faster than the fastest wave, a pressure that is put on at once and
/// near the stiffness of what it presses, steps longer than their bound, a material that no body is of, particles whose
/// mass is not their solid's, and a body with few cells to its half width on its way into another one.
std::vector<std::string> plausibility_warnings(const CheckedScene& checked);

/// Where a scene takes a material for another one than was tested: a line each, with its place. A density more than 5 %
/// from that of the samples, and measured strains that are read as others. A report's scene may mean it, so that a run
/// does not say it again.
std::vector<std::string> material_warnings(const CheckedScene& checked);

/// Where bodies that move feel each other before they touch, by the normal of their contact, or a wall, or only once
/// they overlap, as their tips hold no particle: a line each, with its place. All shrink with the cells, so that a run
/// does not say it again.
std::vector<std::string> contact_warnings(const CheckedScene& checked);

}  // namespace tamp::tools
