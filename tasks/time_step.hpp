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
template <int D>
runtime::TaskList time_step(const Method<D>& method, std::function<bool(const StepTotals&)> accepted);

/// The particle data that last from step to step, and the results that the host takes.
template <int D>
runtime::HostData host_data(const Method<D>& method);

}  // namespace tamp::tasks
