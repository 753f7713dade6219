#pragma once

#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// Moves the state of all patches from one dealing of patches to ranks into another: between steps, collective.
void move_patches(Warehouse& from, Warehouse& to, const Communicator& communicator);

}  // namespace tamp::runtime
