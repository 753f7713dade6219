#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "components/materials/state_columns.hpp"
#include "runtime/data/combine.hpp"
#include "runtime/data/views.hpp"
#include "runtime/graph/task_graph.hpp"
#include "tasks/method.hpp"
#include "tasks/report/body_sums.hpp"

namespace tamp::tasks
{

/// Extremes over the particles of one material; compression positive.
struct MaterialPeaks {
  MaterialPeaks() { extremes.fill(-std::numeric_limits<double>::infinity()); }

  /// Mean stress -tr sigma / 3 and q = sqrt(3 J2) [Pa].
  double pressure = -std::numeric_limits<double>::infinity();
  double q = 0;
  /// The greatest values of the columns of `state_extremes`, and the greatest negative ones for the least.
  std::array<double, components::max_state_columns> extremes;

  static constexpr auto fields =
      std::tuple{runtime::Greatest{&MaterialPeaks::pressure}, runtime::Greatest{&MaterialPeaks::q},
                 runtime::Greatest{&MaterialPeaks::extremes}};

  void add(std::span<const components::Invariants> stress);
  /// Takes in the states of particles, `state(i)`, with their stresses.
  template <class Model, class State>
  void add(const Model& model, const State& state, std::span<const components::Invariants> stress);

  /// The extreme number `k` of `state_extremes`; infinite where there was no particle.
  double extreme(std::size_t k, const components::StateExtreme& of) const
  {
    return of.greatest ? extremes[k] : -extremes[k];
  }
};

using PeaksOfMaterials = std::array<MaterialPeaks, runtime::PerGroup<int>::max_groups>;

/// How far the particles of a body are from where its exact solution has them.
struct DisplacementError {
  double mass = 0;
  double mass_times_square = 0;  ///< sum m e^2 [kg m^2]
  double greatest = 0;           ///< m

  static constexpr auto fields = std::tuple{&DisplacementError::mass, &DisplacementError::mass_times_square,
                                            runtime::Greatest{&DisplacementError::greatest}};

  void add(double particle_mass, double error);

  /// Root of the mean square, by mass [m].
  double rms() const;
};

/// The state of all particles in a few numbers.
struct ParticleReport {
  static constexpr std::size_t max_entries = runtime::PerGroup<int>::max_groups;

  double kinetic = 0;
  /// sum m |v| [N s], which cancels nowhere; of a rigid body what it would be if all of it moved at the root of its
  /// mean square speed, which is no less.
  double sum_of_momenta = 0;
  /// sum m (g . x + |w x r|^2 / 2) [J]: what it has gained since the start is the work of gravity and of a steady
  /// centrifuge. One that speeds up has no such function: its work is left out, and an energy balance does not close.
  double gravity_work = 0;
  /// Work of these in the second half of the last step [J], which velocities, of half a step before, do not have yet.
  double gravity_work_at_end = 0;
  std::array<BodySums, max_entries> bodies;
  /// Only for bodies that have an exact solution.
  std::array<DisplacementError, max_entries> displacement_errors;
  PeaksOfMaterials materials;

  static constexpr auto fields = std::tuple{&ParticleReport::kinetic,      &ParticleReport::sum_of_momenta,
                                            &ParticleReport::gravity_work, &ParticleReport::gravity_work_at_end,
                                            &ParticleReport::bodies,       &ParticleReport::displacement_errors,
                                            &ParticleReport::materials};

  Eigen::Vector3d momentum() const;
};

/// Peaks of the particles near the nose of a body.
struct NoseReport {
  PeaksOfMaterials materials;

  static constexpr auto fields = std::tuple{&NoseReport::materials};
};

inline const runtime::ReductionLabel<ParticleReport, "particle report"> particle_report;
inline const runtime::ReductionLabel<NoseReport, "nose report"> nose_report;

/// The tasks that make a `particle_report`, and a `nose_report` if a body has a nose, of the state at the end of the
/// last step.
template <int D>
std::vector<runtime::TaskDeclaration> report_tasks(const Method<D>& method);

}  // namespace tamp::tasks
