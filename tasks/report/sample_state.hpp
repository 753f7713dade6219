#pragma once

#include "runtime/graph/declaration.hpp"
#include "runtime/graph/task_graph.hpp"
#include "tasks/method.hpp"
#include "tasks/monitors.hpp"

namespace tamp::tasks
{

/// The tasks that make a `state_sample`, a `swollen_sample` and a `wall_sample` of the state at the end of the last
/// step.
template <int D>
runtime::TaskList sample_tasks(const Method<D>& method);

/// The state that they read, and no more: other groups would get what only one of them has.
template <int D>
runtime::HostData sample_data(const Method<D>& method);

}  // namespace tamp::tasks
