#pragma once

#include <string_view>

#include "components/transfers/transfer.hpp"

namespace tamp::components
{

/// Particle in cell: particles take the velocity of the nodes, and keep nothing of their own (Harlow 1964). What the
/// nodes cannot tell apart is gone after one step, and of the rest a part in each.
struct Pic : PlainTransfer {
  static constexpr std::string_view word = "pic";
  static constexpr std::string_view meaning = "particles take the nodes' velocities";
};

}  // namespace tamp::components
