#pragma once

namespace tamp::tools
{

/// Cores that this process may use: a batch system or mpirun may have given it fewer than the machine has.
int usable_cores();

}  // namespace tamp::tools
