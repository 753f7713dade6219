#pragma once

#include "runtime/graph/declaration.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// The tasks that make a `wall_sample` of the state at the end of the last step; none where no wall has an image.
template <int D>
runtime::TaskList wall_sample_tasks(const Method<D>& method);

}  // namespace tamp::tasks
