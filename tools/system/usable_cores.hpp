#pragma once

#include "runtime/ranks/communicator.hpp"

namespace tamp::tools
{

/// The cores that the ranks on this machine may use, and how many of them there are for this rank.
struct UsableCores {
  int of_machine;
  /// Its share of all, 1 at least; no more than it is bound to.
  int of_rank;
  int ranks_on_machine;
};

/// Collective.
UsableCores usable_cores(const runtime::Communicator& communicator = {});

}  // namespace tamp::tools
