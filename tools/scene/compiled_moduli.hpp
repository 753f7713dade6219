#pragma once

#include <string>
#include <vector>

#include "tools/scene/read_scene.hpp"

namespace tamp::tools
{

/// A line for each material whose modulus was compiled into a surface: its
/// size, and how far it is from its model.
std::vector<std::string> compiled_moduli(const CheckedScene& checked);

}  // namespace tamp::tools
