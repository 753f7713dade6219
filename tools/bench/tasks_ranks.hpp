#pragma once

#include "runtime/ranks/communicator.hpp"
#include "tools/bench/bench.hpp"

namespace tamp::tools::bench
{

/// The tasks of patches in a row over ranks, with one thread each: what the exchange of halos costs, against plain MPI.
/// Collective; all ranks get the result.
Result rank_tasks(const TaskOptions& options, const runtime::Communicator& ranks);

}  // namespace tamp::tools::bench
