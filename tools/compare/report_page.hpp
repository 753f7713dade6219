#pragma once

#include <string>

#include "tools/compare/comparison.hpp"

namespace tamp::tools::compare
{

/// `report.html`: one page that needs nothing else, with the figures of the models in a table and their plots over
/// simulated time: wall time, cost per step and step size, depth, and the peaks of the sand.
std::string report_page(const Comparison& comparison);

}  // namespace tamp::tools::compare
