#pragma once

#include <exception>

#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// Whether an exception is a StepError.
bool is_step_error(const std::exception_ptr& error);

/// Throws on all ranks what the first of them that has an error of its own (`own`, else null) has: a StepError if it is
/// one and all are at the same step, so that there is a common last good state; else std::runtime_error. Collective, of
/// ranks that have stopped in the middle of a step.
[[noreturn]] void throw_common_failure(const std::exception_ptr& own, long step, const Communicator& communicator);

}  // namespace tamp::runtime
