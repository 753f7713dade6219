#pragma once

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/row_share.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// Where this rank's particles of a group stand in a table of those of all ranks, patch after patch. Collective.
RowShare particle_share(const Warehouse& warehouse, int group, const Communicator& communicator);

}  // namespace tamp::runtime
