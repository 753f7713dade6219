#pragma once

#include <functional>
#include <vector>

#include "runtime/graph/task_graph.hpp"
#include "tasks/method.hpp"
#include "tasks/step_totals.hpp"

namespace tamp::tasks
{

/// The phases of one time step, in order: the table of contents of the method. Where the totals of a step are not
/// `accepted`, particles stay where they are stored, so that the state before the step is whole.
template <class Interpolator>
std::vector<runtime::TaskDeclaration> time_step(const Method<Interpolator>& method,
                                                std::function<bool(const StepTotals&)> accepted);

/// The particle data that last from step to step, and the results that the host takes.
template <class Interpolator>
runtime::HostData host_data(const Method<Interpolator>& method);

}  // namespace tamp::tasks
