#pragma once

#include "runtime/graph/task_graph.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// The phases of one time step, in order: the table of contents of the method. Where one of them throws, or the last
/// refuses the step, the state before the step is whole.
template <int D>
runtime::TaskList time_step(const Method<D>& method);

/// Data that last from step to step, and results that the host takes.
template <int D>
runtime::HostData host_data(const Method<D>& method);

}  // namespace tamp::tasks
