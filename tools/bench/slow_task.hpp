#pragma once

#include <string>

#include "runtime/graph/declaration.hpp"

namespace tamp::tools::bench
{

/// Makes a task of a step take `factor` times as long, by having its worker spin after each run of its body. The body
/// itself is wrapped, so that nothing else is slower, neither in this step nor in any other program. False if the step
/// has no such task.
bool slow_down(runtime::TaskList& step, const std::string& task, double factor);

}  // namespace tamp::tools::bench
