#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/data/views.hpp"
#include "tasks/scene_time.hpp"
#include "tasks/step_totals.hpp"

/// Records of the particles, and the other causes, that set the lengths of the steps of a run.
namespace tamp::tasks
{

/// The cause that sets the length of a step.
enum class StepCause {
  particle,      ///< a particle's own bound
  bodies,        ///< bodies that meet, or a rigid one on its way through a cell
  start,         ///< the first step, which bodies bound as a whole
  maximum_step,  ///< the longest that the scene allows
  redone,        ///< repeated, as a longer step was refused
  end            ///< the end of the simulated time
};
inline constexpr std::size_t n_step_causes = 6;

/// The cause of the length of a step of `size` [s] that had to keep within `bound`.
StepCause cause_of(double size, const SceneTime& time, const StepBound& bound, bool is_first, bool is_redone);

/// A step that a particle set.
struct SetStep {
  std::int64_t step = 0;  ///< its number, from 1; 0: none
  double time = 0;        ///< time at its end [s]
  double size = 0;        ///< s
  /// The particle that set it, in its state when the step began.
  StepSetter setter;
};

/// Records of what set the lengths of the steps of a run so far.
struct StepRecords {
  /// The first, the shortest and the last step that a particle set; of equally short ones the first.
  SetStep first, shortest, last;
  /// How many steps particles set, by their material.
  std::array<std::int64_t, runtime::PerGroup<int>::max_groups> by_material{};
  /// How many steps each StepCause set.
  std::array<std::int64_t, n_step_causes> by_cause{};

  std::int64_t count(StepCause cause) const { return by_cause[static_cast<std::size_t>(cause)]; }
  /// Adds a step; its setter counts only where the cause is a particle.
  void add(StepCause cause, const SetStep& step);
};

}  // namespace tamp::tasks
