#pragma once

#include <string_view>

#include "components/transfers/flip.hpp"
#include "components/transfers/transfer.hpp"

namespace tamp::components
{

/// A part of FLIP, and PIC for the rest (Stomakhin et al., ACM Trans. Graph. 32, 2013).
struct Blend : PlainTransfer {
  static constexpr std::string_view word = "blend";
  static constexpr std::string_view meaning = "a part of each of these";
  static constexpr std::string_view own_key = "flip_part";

  /// Part of FLIP in the velocity, from 0 to 1.
  double flip_part;

  explicit Blend(const TransferNumbers& numbers) : flip_part(numbers.flip_part) {}

  template <int D>
  Vector<D> velocity(const Vector<D>& before, const ParticleMotion<D>& motion, const Vector<D>& restored) const
  {
    return flip_part * Flip{}.velocity(before, motion, restored) + (1 - flip_part) * motion.velocity;
  }
};

}  // namespace tamp::components
