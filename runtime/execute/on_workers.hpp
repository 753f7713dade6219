#pragma once

#include <functional>

#include "runtime/execute/executor.hpp"

namespace tamp::runtime
{

/// Calls `work(i)` once for each i from 0 to n - 1, on all workers of an executor that runs nothing else, in no order.
/// No two calls may touch the same data unless all of them only read it. What one throws is thrown here.
void on_workers(Executor& executor, int n, const std::function<void(int)>& work);

}  // namespace tamp::runtime
