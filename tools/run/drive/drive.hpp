#pragma once

#include <functional>

#include "tasks/scene.hpp"
#include "tools/run/drive/material_point.hpp"
#include "tools/run/drive/path.hpp"

namespace tamp::tools
{

/// Takes a fresh point of a material along a path and shows it at the first row and after every increment. Each segment
/// is cut into equal increments of time, as few as keep the strain of each (its norm) within `largest_strain`, and the
/// superposed rotation within 0.1 rad; sand accepts strains up to 0.2.
/// Throws SimulationError, with the time and the row that was being approached, where the material fails.
void drive(const tasks::SceneMaterial& material, const DeformationPath& path, double largest_strain,
           const std::function<void(double time, const MaterialPoint& point)>& show);

}  // namespace tamp::tools
