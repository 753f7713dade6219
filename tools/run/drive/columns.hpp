#pragma once

#include <string>
#include <vector>

#include "tools/run/drive/material_point.hpp"

namespace tamp::tools
{

/// The columns of what `tamp drive` writes of a material, with those that its model shows of its state. Compression is
/// positive for p, strain_v and the state's columns; tension for the components of the Cauchy stress.
std::vector<std::string> drive_columns(const tasks::MaterialModel& material);

/// The values of the columns at a time [s].
std::vector<double> drive_values(const tasks::MaterialModel& material, double time, const MaterialPoint& point);

}  // namespace tamp::tools
