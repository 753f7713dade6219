#pragma once

#include "runtime/graph/declaration.hpp"
#include "tasks/method.hpp"
#include "tasks/monitors.hpp"

namespace tamp::tasks
{

/// The tasks that make a `state_sample` of the state at the end of the last step.
template <int D>
runtime::TaskList sample_tasks(const Method<D>& method);

}  // namespace tamp::tasks
