#pragma once

#include <vector>

#include "runtime/graph/task_graph.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// The phases of one time step, in order: the table of contents of the method.
template <class Interpolator>
std::vector<runtime::TaskDeclaration> time_step(const Method<Interpolator>& method);

/// The particle data that last from step to step, and the results that the host takes.
template <class Interpolator>
runtime::HostData host_data();

}  // namespace tamp::tasks
