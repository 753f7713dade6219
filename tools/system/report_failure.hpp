#pragma once

#include <string>

#include "runtime/ranks/communicator.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

/// Ends a program that has failed, on one of its ranks or on all, with one message on stderr. If all ranks fail, as
/// they do of what they find together, they agree on the exit code, and the first of them that knows why tells it. If
/// the others go on, they are ended within seconds. `text` is empty on a rank that only knows that another has failed.
int report_failure(const std::string& text, ExitCode code, const runtime::Communicator& ranks);

}  // namespace tamp::tools
