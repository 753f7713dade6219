#pragma once

#include <variant>

#include "components/problems/axis_aligned.hpp"
#include "components/problems/cavity.hpp"
#include "components/problems/compacted_column.hpp"
#include "components/problems/ring.hpp"
#include "components/problems/rotating_disk.hpp"
#include "components/problems/vibrating_bar.hpp"
#include "components/problems/vortex.hpp"

/// Requirements of a problem:
///
///  - `type`, its name in scenes, and `meaning`, what it does with a body, for people;
///  - `parameters()`, what a scene gives it, see parameter.hpp;
///  - `functions(body)`, which throws BadParameter for a parameter that does not go with the others, and BadValue for a
///    body that the problem cannot be set for.
namespace tamp::components
{

/// All the problems there are; one more is added here.
using Problem = std::variant<AxisAligned, Cavity, CompactedColumn, Ring, RotatingDisk, VibratingBar, Vortex>;

}  // namespace tamp::components
