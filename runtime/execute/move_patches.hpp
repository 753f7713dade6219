#pragma once

#include "runtime/data/warehouse.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// Moves the state of all patches from one dealing of patches to ranks into another: between steps, collective.
void move_patches(Warehouse& from, Warehouse& to, const Communicator& communicator);

}  // namespace tamp::runtime
