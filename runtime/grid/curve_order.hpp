#pragma once

#include <vector>

#include "runtime/grid/index_box.hpp"

namespace tamp::runtime
{

/// The places of a box of n[0] x n[1] x n[2], numbered with x fastest, in the order in which a Hilbert curve passes
/// them: places near in the order are near in space.
std::vector<int> curve_order(const Index& n);

}  // namespace tamp::runtime
