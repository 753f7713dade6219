#pragma once

#include <cmath>

#include "components/tensors.hpp"

namespace tamp::components
{

/// Local damping (P. A. Cundall, 1987): a part of the unbalanced force of each node, along each axis, always against
/// its velocity. It takes energy from what swings, and leaves what is at rest under its loads as it is.
///
/// Damped velocity change of a node [m/s] from the one that the forces would give it; `part` is from 0 to
/// below 1.
template <int D>
Vector<D> damped_change(const Vector<D>& velocity, const Vector<D>& change, double part)
{
  Vector<D> damped = change;
  for (int k = 0; k < D; ++k) {
    if (velocity[k] != 0) damped[k] -= std::copysign(part * std::abs(change[k]), velocity[k]);
  }
  return damped;
}

}  // namespace tamp::components
