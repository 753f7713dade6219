#pragma once

#include <optional>

#include "tasks/scene.hpp"
#include "tasks/simulation_error.hpp"
#include "tasks/step_totals.hpp"

namespace tamp::tasks
{

/// Why a step of `size` [s] cannot be taken; nothing if it can. `step` are its own totals, `before` those of all steps
/// before it.
std::optional<SimulationError> refusal(const Scene& scene, const StepTotals& before, const StepTotals& step,
                                       double size);

}  // namespace tamp::tasks
