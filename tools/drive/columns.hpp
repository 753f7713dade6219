#pragma once

#include <string>
#include <vector>

#include "tools/drive/material_point.hpp"

namespace tamp::tools
{

/// The columns of what `tamp drive` writes. Compression is positive for p, strain_v, elastic_v, plastic_v and cap;
/// tension for the components of the Cauchy stress. What only sand has is 0 for other materials, but in_range 1.
std::vector<std::string> drive_columns();

/// The values of the columns at a time [s].
std::vector<double> drive_values(const tasks::MaterialModel& material, double time, const MaterialPoint& point);

}  // namespace tamp::tools
