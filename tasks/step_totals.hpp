#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace tamp::tasks
{

/// Sums and bounds over all particles and nodes of one step.
struct StepTotals {
  /// The longest next step that is stable, before the multiplier [s].
  double stable_step = std::numeric_limits<double>::infinity();
  /// Work stored, and work turned to heat, in this step [J].
  double elastic = 0;
  double plastic = 0;
  double viscous = 0;
  double contact = 0;
  /// Substeps of sand, and those of them that were as short as they may be and still beyond the tolerance.
  std::size_t substeps = 0;
  std::size_t limited_substeps = 0;

  void combine(const StepTotals& other)
  {
    stable_step = std::min(stable_step, other.stable_step);
    elastic += other.elastic;
    plastic += other.plastic;
    viscous += other.viscous;
    contact += other.contact;
    substeps += other.substeps;
    limited_substeps += other.limited_substeps;
  }
};

/// What all particles take from the nodes in one step [N s]: gravity and the walls; forces within and between bodies
/// cancel.
struct GridImpulse {
  std::array<double, 3> value{0, 0, 0};

  void combine(const GridImpulse& other)
  {
    for (std::size_t k = 0; k < 3; ++k) value[k] += other.value[k];
  }
};

}  // namespace tamp::tasks
