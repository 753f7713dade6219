#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "components/errors.hpp"
#include "components/materials/material_model.hpp"
#include "components/materials/state_columns.hpp"
#include "runtime/data/views.hpp"

namespace tamp::tasks
{

/// A particle whose stress could not be updated, and the state it was left in.
struct FailedUpdate {
  std::int64_t particle = -1;  ///< -1: none
  int material = -1;
  std::array<double, 3> position{};  ///< m
  components::UpdateFault fault{};
  double pressure = 0, q = 0;                                 ///< Pa, compression positive
  double volumetric_increment = 0, deviatoric_increment = 0;  ///< of strain, refused; compression positive
  /// The columns of its model's state.
  std::array<double, components::max_state_columns> state{};

  /// With all of the above in words.
  std::string reason(const components::MaterialModel& model) const;
};

/// Sums and bounds over all particles and nodes of one step.
struct StepTotals {
  /// The longest next step that is stable, before the multiplier [s].
  double stable_step = std::numeric_limits<double>::infinity();
  /// Work stored, and work turned to heat, in this step [J].
  double elastic = 0;
  double plastic = 0;
  double viscous = 0;  ///< by artificial viscosity
  double contact = 0;
  /// Work of what drives bodies, in this step [J].
  double driving = 0;
  /// What stress takes from the motion at the end of this step in its second half, as particles tell: half of the sum
  /// of V sigma:strain, with viscous pressure [J].
  double taken_at_end = 0;
  /// Stress updates of all materials.
  components::UpdateCounts updates;
  /// The failed update with the lowest id in the first step that had any.
  FailedUpdate failed;

  void note(const FailedUpdate& other)
  {
    if (failed.particle < 0 || other.particle < failed.particle) failed = other;
  }

  void combine(const StepTotals& other)
  {
    stable_step = std::min(stable_step, other.stable_step);
    elastic += other.elastic;
    plastic += other.plastic;
    viscous += other.viscous;
    contact += other.contact;
    driving += other.driving;
    taken_at_end += other.taken_at_end;
    updates.add(other.updates);
    if (other.failed.particle >= 0) note(other.failed);
  }
};

/// Work of body forces in one step [J].
struct BodyForceWork {
  double value = 0;
  /// By the forces of its end, in its second half.
  double at_end = 0;

  void combine(const BodyForceWork& other)
  {
    value += other.value;
    at_end += other.at_end;
  }
};

/// Sums over the nodes of one step, and over what their particles take from them.
struct GridTotals {
  /// What all particles take from the nodes [N s]: gravity, loads and the walls; forces within and between bodies
  /// cancel. What transfers that filter velocities add is here too: 0 but where images behind walls have a part.
  std::array<double, 3> impulse{0, 0, 0};
  /// The energy that walls take by friction and by stopping what runs into them [J].
  double taken_by_walls = 0;
  /// That which local damping takes [J].
  double taken_by_damping = 0;
  /// Kinetic energy that the nodes of deformable materials gain, and what of it their particles do [J].
  double gained_by_nodes = 0, gained_by_particles = 0;
  /// That which rigid bodies gain [J].
  double gained_by_rigid_bodies = 0;
  /// What gravity and a steady centrifuge do to all particles, and to those of the end of the step in its second half,
  /// which velocities, of half a step before, do not have yet [J].
  double gravity_work = 0, gravity_work_at_end = 0;
  /// What forces take from these nodes [J]: at their velocities at the start of the step in the half of the step
  /// before, minus the sum of f.v dt/2; where particles deform by other velocities in the whole kick.
  double taken_by_forces = 0;

  void combine(const GridTotals& other)
  {
    for (std::size_t k = 0; k < 3; ++k) impulse[k] += other.impulse[k];
    taken_by_walls += other.taken_by_walls;
    taken_by_damping += other.taken_by_damping;
    gained_by_nodes += other.gained_by_nodes;
    gained_by_particles += other.gained_by_particles;
    gained_by_rigid_bodies += other.gained_by_rigid_bodies;
    gravity_work += other.gravity_work;
    gravity_work_at_end += other.gravity_work_at_end;
    taken_by_forces += other.taken_by_forces;
  }
};

/// What pressure loads do in one step.
struct LoadTotals {
  /// To each material [N s].
  std::array<std::array<double, 3>, runtime::PerGroup<int>::max_groups> impulse{};
  double work = 0;  ///< J
  /// At the velocities of the start of the step, in the half of the step before [J].
  double work_at_start = 0;

  void combine(const LoadTotals& other)
  {
    work += other.work;
    work_at_start += other.work_at_start;
    for (std::size_t g = 0; g < impulse.size(); ++g) {
      for (std::size_t k = 0; k < 3; ++k) impulse[g][k] += other.impulse[g][k];
    }
  }
};

}  // namespace tamp::tasks
