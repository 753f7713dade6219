#pragma once

#include <string>
#include <vector>

#include "tools/run/drive/mixed_path.hpp"

namespace tamp::tools
{

/// The components of stress that the columns of a CSV path prescribe; none where all is deformation. A path has the
/// columns `time` and, for each axis, F11 or S11 and so on; beside them any other F, and S12, S13 or S23 in place of
/// F12, F13 or F23. Throws InputError, with `place`, the heading's FILE:LINE, for all that does not go together.
std::vector<StressControl> stress_controls(const std::vector<std::string>& columns, const std::string& place);

}  // namespace tamp::tools
