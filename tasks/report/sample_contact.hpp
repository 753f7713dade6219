#pragma once

#include "runtime/graph/declaration.hpp"
#include "runtime/graph/task_graph.hpp"
#include "tasks/method.hpp"
#include "tasks/monitors.hpp"

namespace tamp::tasks
{

/// The tasks that make a `contact_sample` of what contact will do in the next step, between materials whose normal is
/// not that by regression, which lets only such push each other as touch. They run before that step, whose grid they
/// fill. Where stress comes first (`usf`) the step's forces are not known before it, and there are no tasks.
template <int D>
runtime::TaskList contact_sample_tasks(const Method<D>& method);

/// The state that they read, and no more.
template <int D>
runtime::HostData contact_sample_data(const Method<D>& method);

}  // namespace tamp::tasks
