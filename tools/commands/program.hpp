#pragma once

#include "runtime/ranks/communicator.hpp"

namespace tamp::tools
{

/// Does what the command line asks for, with the ranks that share its work; returns the exit code. Throws what the
/// command throws.
int run_program(int argc, char** argv, const runtime::Communicator& ranks);

}  // namespace tamp::tools
