#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "runtime/data/views.hpp"
#include "runtime/graph/task_graph.hpp"
#include "tasks/body_sums.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// Extremes over the particles of one material; compression positive.
struct MaterialPeaks {
  /// Mean stress -tr sigma / 3 and q = sqrt(3 J2) [Pa].
  double pressure = -std::numeric_limits<double>::infinity();
  double q = 0;
  /// Of tabular caps: crush pressure [Pa] and plastic volumetric strain.
  double cap = 0;
  double plastic_volumetric = -std::numeric_limits<double>::infinity();
  double least_plastic_volumetric = std::numeric_limits<double>::infinity();

  template <int Size>
  void add(const Eigen::Matrix<double, Size, 1>& stress);
  void add(const components::TabularCap& sand, const components::CapState& state);
  void combine(const MaterialPeaks& other);
};

using PeaksOfMaterials = std::array<MaterialPeaks, runtime::PerGroup<int>::max_groups>;

/// The state of all particles in a few numbers.
struct ParticleReport {
  static constexpr std::size_t max_entries = runtime::PerGroup<int>::max_groups;

  double kinetic = 0;
  /// sum m (g . x + |w x r|^2 / 2) [J]: what it has gained since the start is the work of gravity and of a steady
  /// centrifuge. One that speeds up has no such function: its work is left out, and an energy balance does not close.
  double gravity_work = 0;
  std::array<BodySums, max_entries> bodies;
  PeaksOfMaterials materials;

  Eigen::Vector3d momentum() const;
  void combine(const ParticleReport& other);
};

/// The same peaks of the particles that are near the nose of a body.
struct NoseReport {
  PeaksOfMaterials materials;

  void combine(const NoseReport& other);
};

inline const runtime::ReductionLabel<ParticleReport, "particle report"> particle_report;
inline const runtime::ReductionLabel<NoseReport, "nose report"> nose_report;

/// The tasks that make a `particle_report`, and a `nose_report` if a body has a nose, of the state at the end of the
/// last step.
template <class Interpolator>
std::vector<runtime::TaskDeclaration> report_tasks(const Method<Interpolator>& method);

}  // namespace tamp::tasks
