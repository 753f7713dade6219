#pragma once

#include "tools/run/drive/material_point.hpp"
#include "tools/run/drive/mixed_path.hpp"

namespace tamp::tools
{

/// The state that an increment is to end in.
struct MixedTarget {
  const std::vector<StressControl>& controls;
  Matrix<3> deformation_gradient;  ///< entries that give way to stress are not read
  std::vector<double> stress;      ///< of each control [Pa], tension positive
};

/// Takes the point to the target in one increment: a damped Newton iteration on the entries of F that give way, each
/// trial made from the point as it was, until every controlled stress is within 1e-10 of the largest stress (that of
/// the point, or wanted) plus 1e-12 of the modulus K + 4G/3. No step of the iteration is longer than `largest_step`, as
/// a change of F. False where it finds nothing; the point is then as it was.
bool deform_to_stress(const tasks::MaterialModel& material, const MixedTarget& target, double largest_step,
                      MaterialPoint& point);

}  // namespace tamp::tools
