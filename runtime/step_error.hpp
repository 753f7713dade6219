#pragma once

#include <stdexcept>

namespace tamp::runtime
{

/// Thrown by a task where the state does not allow the step, though the program is in order. All ranks then throw it,
/// and the state before the step is the last good one.
struct StepError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace tamp::runtime
