#pragma once

#include "components/transfers/flip.hpp"
#include "components/transfers/transfer.hpp"

namespace tamp::components
{

/// A part of FLIP, and PIC for the rest (Stomakhin et al., ACM Trans. Graph. 32, 2013).
struct Blend : PlainTransfer {
  /// 0 to 1.
  double flip_part;

  template <int D>
  Vector<D> velocity(const Vector<D>& before, const ParticleMotion<D>& motion, const Vector<D>& restored) const
  {
    return flip_part * Flip{}.velocity(before, motion, restored) + (1 - flip_part) * motion.velocity;
  }
};

}  // namespace tamp::components
