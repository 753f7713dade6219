#pragma once

#include <string>
#include <vector>

namespace tamp::runtime
{

/// Finds the name among `names` that `name` may be a misspelling of (a few edits away); empty when none is near.
std::string near_name(const std::string& name, const std::vector<std::string>& names);

}  // namespace tamp::runtime
