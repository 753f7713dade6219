#pragma once

#include <cstdint>
#include <span>

#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// A question to the first rank's clock: this rank's ticks when it asked and when it heard the answer, and the answer.
struct RoundTrip {
  std::uint64_t asked = 0;
  std::uint64_t answer = 0;
  std::uint64_t heard = 0;
};

/// The same moment on two clocks, in the ticks of each. However long the way there and the way back took, the first
/// rank's ticks are off by no more than `uncertainty`, half of the round trip.
struct ClockPair {
  std::uint64_t own = 0;
  std::uint64_t first_rank = 0;
  std::uint64_t uncertainty = 0;
};

/// The pair that the shortest of at least one round trips tells: halfway between question and answer.
ClockPair shortest_of(std::span<const RoundTrip> trips);

/// Asks for the first rank's clock on all others, one after the other; on the first itself a pair of equals.
/// Collective.
ClockPair ask_first_rank(const Communicator& communicator);

/// Turns ticks of this rank into the first rank's, by the line through two pairs: the clocks may run at speeds that
/// differ a little. Where both pairs cannot tell the clocks apart, they are the same, as those of one machine are.
class ClockLine
{
 public:
  ClockLine() = default;
  ClockLine(const ClockPair& begin, const ClockPair& end);

  /// The first rank's ticks at a tick of this rank; known to `uncertainty` for ticks between the two pairs.
  std::uint64_t first_rank(std::uint64_t own) const;
  /// Whether the two clocks are the same, like those of one machine.
  bool is_the_same() const { return own_ == first_rank_ && drift_ == 0; }
  /// Uncertainty of `first_rank` [ticks of this rank].
  std::uint64_t uncertainty() const { return uncertainty_; }

 private:
  std::uint64_t own_ = 0;
  std::uint64_t first_rank_ = 0;
  /// Relative excess of the first rank's clock rate.
  double drift_ = 0;
  std::uint64_t uncertainty_ = 0;
};

}  // namespace tamp::runtime
