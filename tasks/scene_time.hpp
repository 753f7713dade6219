#pragma once

#include <array>
#include <limits>

#include "components/loads/time_step.hpp"
#include "components/parameter.hpp"

namespace tamp::tasks
{

using components::StepRule;

struct SceneTime {
  double end;
  StepRule rule = StepRule::viscous;
  /// The part of the bound that is used.
  double multiplier = 0.8;
  double minimum_step = 1e-12;
  double maximum_step = std::numeric_limits<double>::infinity();
  /// A step that goes wrong is tried so many times again, each as much of the time before.
  int redos = 8;
  double redo_factor = 0.5;

  /// All but the rule.
  static constexpr std::array<components::Parameter<SceneTime>, 6> parameters();
};

constexpr std::array<components::Parameter<SceneTime>, 6> SceneTime::parameters()
{
  using components::above_zero;
  return {{{"end", "s", above_zero, &SceneTime::end, "simulated time"},
           {"multiplier",
            "",
            {.lower = 0, .upper = 100, .holds_lower = false},
            &SceneTime::multiplier,
            "the part of that bound that is used, above 0 and up to 100; above 1 steps are longer than is known to be "
            "stable",
            true},
           {"minimum_step", "s", above_zero, &SceneTime::minimum_step,
            "the run stops as unstable if its time step has to be shorter", true},
           {"maximum_step", "s", above_zero, &SceneTime::maximum_step, "longest time step", true},
           {"redos",
            "",
            {.lower = 0, .upper = 100},
            &SceneTime::redos,
            "a step that goes wrong is tried again, shorter, at most so many times, see when_a_run_warns.md; 0: the "
            "run ends",
            true},
           {"redo_factor",
            "",
            {.lower = 0, .upper = 1, .holds_lower = false, .holds_upper = false},
            &SceneTime::redo_factor,
            "the length of a step that is tried again, as a part of the one that went wrong",
            true}}};
}

}  // namespace tamp::tasks
