#pragma once

#include "components/transfers/transfer.hpp"

namespace tamp::components
{

/// Particle in cell: particles take the velocity of the nodes, and keep nothing of their own (Harlow 1964). What the
/// nodes cannot tell apart is gone after one step, and of the rest a part in each.
struct Pic : PlainTransfer {
};

}  // namespace tamp::components
