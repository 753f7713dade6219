#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/data/views.hpp"
#include "tasks/scene_time.hpp"
#include "tasks/step_totals.hpp"

/// Which particles, and what else, set the length of the steps of a run.
namespace tamp::tasks
{

/// What sets the length of a step.
enum class StepCause {
  particle,      ///< its bound
  bodies,        ///< those that meet, or a rigid one on its way through a cell
  start,         ///< the first step, which bodies bound as a whole
  maximum_step,  ///< the longest that the scene allows
  redone,        ///< it went wrong when it was longer
  end            ///< of the simulated time
};
inline constexpr std::size_t n_step_causes = 6;

/// What set a step of `size` [s] that had to keep within `bound`.
StepCause cause_of(double size, const SceneTime& time, const StepBound& bound, bool is_first, bool is_redone);

/// A step that a particle set.
struct SetStep {
  std::int64_t step = 0;  ///< its number, from 1; 0: none
  double time = 0;        ///< of its end [s]
  double size = 0;        ///< s
  /// As it was when the step began.
  StepSetter setter;
};

/// What set the steps of a run so far.
struct StepRecords {
  /// Of the steps that particles set; the shortest is the first of equal ones.
  SetStep first, shortest, last;
  /// How many steps particles set, by their material.
  std::array<std::int64_t, runtime::PerGroup<int>::max_groups> by_material{};
  /// How many steps each StepCause set.
  std::array<std::int64_t, n_step_causes> by_cause{};

  std::int64_t count(StepCause cause) const { return by_cause[static_cast<std::size_t>(cause)]; }
  /// Its setter counts only where the cause is a particle.
  void add(StepCause cause, const SetStep& step);
};

}  // namespace tamp::tasks
