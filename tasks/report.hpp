#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "runtime/data/views.hpp"
#include "runtime/graph/task_graph.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// Sums over the particles of one body, from which its motion as a whole follows. In plane strain the third
/// coordinates are 0. SI units; a slab of 1 m.
struct BodySums {
  double mass = 0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  /// sum m x, and sum m X of where they were at the start.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d reference_position = Eigen::Vector3d::Zero();
  /// sum m (X . x) and sum m (X cross x) within the x-y plane.
  double aligned = 0;
  double turned = 0;

  void combine(const BodySums& other);
  /// Angle of the rotation in the x-y plane that fits the motion from the start best, anticlockwise [rad].
  double tilt() const;
};

/// Extremes over the particles of one material; compression positive.
struct MaterialPeaks {
  /// Mean stress -tr sigma / 3 and q = sqrt(3 J2) [Pa].
  double pressure = -std::numeric_limits<double>::infinity();
  double q = 0;
  /// Of tabular caps: crush pressure [Pa] and plastic volumetric strain.
  double cap = 0;
  double plastic_volumetric = -std::numeric_limits<double>::infinity();
  double least_plastic_volumetric = std::numeric_limits<double>::infinity();

  void combine(const MaterialPeaks& other);
};

/// The state of all particles in a few numbers.
struct ParticleReport {
  static constexpr std::size_t max_entries = runtime::PerGroup<int>::max_groups;

  double kinetic = 0;
  /// sum m g . x [J]: what it has gained since the start is the work of gravity.
  double gravity_work = 0;
  std::array<BodySums, max_entries> bodies;
  std::array<MaterialPeaks, max_entries> materials;

  Eigen::Vector3d momentum() const;
  void combine(const ParticleReport& other);
};

inline const runtime::ReductionLabel<ParticleReport> particle_report{"particle report"};

/// The tasks that make a `particle_report` of the state at the end of the last step.
template <class Interpolator>
std::vector<runtime::TaskDeclaration> report_tasks(const Method<Interpolator>& method);

}  // namespace tamp::tasks
