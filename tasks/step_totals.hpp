#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>

#include "components/errors.hpp"
#include "components/materials/material_model.hpp"
#include "components/materials/state_columns.hpp"
#include "runtime/data/combine.hpp"
#include "runtime/data/views.hpp"
#include "tasks/occurrences.hpp"

namespace tamp::tasks
{

/// Why particles cannot follow the motion of a step.
enum class MotionFault { inside_out, turned_too_far, not_finite };

const char* to_string(MotionFault fault);

/// A particle that could not follow.
struct BadMotion : ParticlePlace {
  MotionFault fault{};
};

/// A particle whose stress could not be updated, and the state it was left in.
struct FailedUpdate : ParticlePlace {
  components::UpdateFault fault{};
  double pressure = 0, q = 0;                                 ///< Pa, compression positive
  double volumetric_increment = 0, deviatoric_increment = 0;  ///< of the refused strain, compression positive
  /// The columns of its model's state.
  std::array<double, components::max_state_columns> state{};

  /// The failure in words, with all of the above.
  std::string reason(const components::MaterialModel& model) const;
};

/// A deformable particle and its own bound on the next step, at the end of this one; its place is that at the start of
/// this step.
struct StepSetter : ParticlePlace {
  double bound = std::numeric_limits<double>::infinity();  ///< s
  double volume_ratio = 0;                                 ///< its volume over that at its material's density
  double pressure = 0;                                     ///< Pa, compression positive
  double wave_speed = 0;                                   ///< of dilatational waves [m/s]

  /// Orders by the bound, and equal bounds by the id.
  bool operator<(const StepSetter& other) const
  {
    return bound < other.bound || (bound == other.bound && ParticlePlace::operator<(other));
  }
};

/// The longest next step that is stable, before the multiplier.
struct StepBound {
  double size = std::numeric_limits<double>::infinity();  ///< s
  /// The particle that sets it; none where contact, a rigid body, or bodies at the start set it.
  StepSetter setter;
};

/// Sums and bounds over all particles and nodes of one step.
struct StepTotals {
  /// The longest next step that is stable, before the multiplier [s].
  double stable_step = std::numeric_limits<double>::infinity();
  /// The greatest wave speed in any particle at the end of the step [m/s].
  double greatest_wave_speed = 0;
  /// Work stored, and work turned to heat, in this step [J].
  double elastic = 0;
  double plastic = 0;
  double viscous = 0;  ///< by artificial viscosity
  double contact = 0;
  /// Work that drives rigid bodies in this step [J].
  double driving = 0;
  /// Work of the stress at the end of this step in its second half, summed over particles: half of the sum of
  /// V sigma:strain, with viscous pressure [J].
  double stress_work_at_end = 0;
  /// Stress updates of all materials.
  components::UpdateCounts updates;
  /// The failed update with the lowest id in the first step that had any.
  FailedUpdate failed;
  /// The bad motion with the lowest id; a step with one is refused.
  BadMotion bad_motion;
  /// The deformable particle with the least bound on the next step.
  StepSetter setter;

  StepBound next_bound() const { return {stable_step, setter.bound == stable_step ? setter : StepSetter{}}; }

  static constexpr auto fields = std::tuple{runtime::Least{&StepTotals::stable_step},
                                            runtime::Greatest{&StepTotals::greatest_wave_speed},
                                            &StepTotals::elastic,
                                            &StepTotals::plastic,
                                            &StepTotals::viscous,
                                            &StepTotals::contact,
                                            &StepTotals::driving,
                                            &StepTotals::stress_work_at_end,
                                            &StepTotals::updates,
                                            runtime::Least{&StepTotals::failed},
                                            runtime::Least{&StepTotals::bad_motion},
                                            runtime::Least{&StepTotals::setter}};
};

/// Work of body forces in one step [J].
struct BodyForceWork {
  double value = 0;
  /// Work of the forces at the end of the step, in its second half [J].
  double at_end = 0;

  static constexpr auto fields = std::tuple{&BodyForceWork::value, &BodyForceWork::at_end};
};

/// Sums of one step over the nodes, and over the exchange of particles with them.
struct GridTotals {
  /// Momentum that all particles take from the nodes [N s], by gravity, loads and walls; forces within and between
  /// bodies cancel. It includes what transfers that filter velocities add, which is 0 but where images behind walls
  /// have a part.
  std::array<double, 3> impulse{0, 0, 0};
  /// Energy that walls take by friction and by stopping matter that runs into them [J].
  double taken_by_walls = 0;
  /// Energy that local damping takes [J].
  double taken_by_damping = 0;
  /// Kinetic energy that the nodes of deformable materials gain, and that which their particles gain [J].
  double gained_by_nodes = 0, gained_by_particles = 0;
  /// Kinetic energy that rigid bodies gain [J].
  double gained_by_rigid_bodies = 0;
  /// Work of gravity and a steady centrifuge on all particles [J]; and the part of it in the second half of the step,
  /// which velocities do not have yet as they are half a step behind [J].
  double gravity_work = 0, gravity_work_at_end = 0;
  /// Work that internal forces f take from these nodes [J]: minus the sum of f.v dt/2 over the half of the step before,
  /// at the velocities v at the start of this one; where particles deform by other velocities, over the whole kick, at
  /// the mean of the velocities before and after it.
  double taken_by_forces = 0;

  static constexpr auto fields =
      std::tuple{&GridTotals::impulse,         &GridTotals::taken_by_walls,      &GridTotals::taken_by_damping,
                 &GridTotals::gained_by_nodes, &GridTotals::gained_by_particles, &GridTotals::gained_by_rigid_bodies,
                 &GridTotals::gravity_work,    &GridTotals::gravity_work_at_end, &GridTotals::taken_by_forces};
};

/// Particles that leave the domain through its open faces.
struct LostParticles {
  std::size_t count = 0;
  double mass = 0;                                     ///< kg
  double kinetic = 0;                                  ///< J
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< N s

  static constexpr auto fields =
      std::tuple{&LostParticles::count, &LostParticles::mass, &LostParticles::kinetic, &LostParticles::momentum};
};

/// Work and impulse of pressure loads in one step.
struct LoadTotals {
  /// Impulse on each material [N s].
  std::array<std::array<double, 3>, runtime::PerGroup<int>::max_groups> impulse{};
  double work = 0;  ///< J
  /// Work at the velocities of the start of the step, in the half step before it [J].
  double work_at_start = 0;

  static constexpr auto fields = std::tuple{&LoadTotals::impulse, &LoadTotals::work, &LoadTotals::work_at_start};
};

}  // namespace tamp::tasks
