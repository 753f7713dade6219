#pragma once

#include <functional>
#include <string>

#include "tasks/scene.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/run/drive/material_point.hpp"

namespace tamp::tools
{

/// Called at the first row of a path, or the start of a test, and after every increment; time in s.
using ShowPoint = std::function<void(double time, const MaterialPoint& point)>;

/// Constant all along a drive.
struct Course {
  const tasks::SceneMaterial& material;
  double largest_strain;  ///< of an increment, its norm
  const ShowPoint& show;
  bool is_test = false;  ///< by a laboratory test, which has no rows

  /// A failure at a time [s] on the way to a row, counted from 1.
  tasks::SimulationError error(const std::string& cause, double time, std::size_t row) const;
};

}  // namespace tamp::tools
