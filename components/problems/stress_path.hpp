#pragma once

#include <vector>

#include "components/materials/material_model.hpp"

namespace tamp::components
{

/// Stress along x and y [Pa] on a path on which nothing turns, from no strain.
struct StressPath {
  /// Length along the path [1]: ln F is that times the path's direction.
  std::vector<double> length;
  std::vector<double> along_x;
  std::vector<double> along_y;
};

/// The straight path of logarithmic strains `direction` along x, y and z up to `last`, by the material's own update in
/// small increments and, where it has a tolerance, with a small one. Throws BadValue where the material finds no
/// stress.
StressPath straight_stress_path(const MaterialModel& material, const Vector<3>& direction, double last);

}  // namespace tamp::components
