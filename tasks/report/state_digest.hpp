#pragma once

#include <string>

#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::tasks
{

/// A hash (64-bit FNV-1a, as 16 hexadecimal digits) of the hashes of every particle's state in the order of their ids:
/// the same for any threads, ranks and order in memory, and different for a single bit of difference. It stays as it is
/// from version to version, whatever files are checked with: digests are compared with older ones. Collective.
std::string state_digest(runtime::Warehouse& warehouse, const runtime::Communicator& communicator);

}  // namespace tamp::tasks
