#pragma once

#include <cstdint>
#include <vector>

#include "runtime/execute/clock_line.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// The clocks of all ranks beside that of the first one, known to all, so that who receives a message knows for how
/// long it was on its way. Where they are not the same, they are compared again and again, as they drift.
class RankClocks
{
 public:
  /// Collective.
  explicit RankClocks(const Communicator& communicator);
  /// Takes lines that are known already, by rank.
  explicit RankClocks(std::vector<ClockLine> lines) : lines_(std::move(lines)) {}

  /// Compares clocks that differ, after 64 steps, 128, 256 and so on. Collective.
  void follow(std::int64_t n_steps);

  /// The first rank's ticks when a rank had these.
  std::uint64_t first_rank(int rank, std::uint64_t ticks) const
  {
    return lines_[static_cast<std::size_t>(rank)].first_rank(ticks);
  }

 private:
  void take(const ClockLine& own);

  Communicator communicator_;
  ClockPair begin_;
  std::vector<ClockLine> lines_;
  bool differ_ = false;
};

}  // namespace tamp::runtime
