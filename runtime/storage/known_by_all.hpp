#pragma once

#include <cstdint>
#include <vector>

#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// Values of which each is known to one rank, which has zeros for the others: all of them, on all ranks. Collective.
std::vector<std::uint64_t> known_by_all(std::vector<std::uint64_t> own, const Communicator& communicator);

}  // namespace tamp::runtime
