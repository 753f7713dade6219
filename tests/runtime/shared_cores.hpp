#pragma once

#include "runtime/execute/executor.hpp"

namespace tamp::test
{

/// Tests over ranks take more workers than there are cores, and may run beside other work: who waits is to sleep soon.
inline runtime::ExecutorOptions on_shared_cores()
{
  runtime::ExecutorOptions options;
  options.oversubscribed = true;
  return options;
}

}  // namespace tamp::test
