#include "runtime/execute/rank_clocks.hpp"

#include <algorithm>
#include <bit>

namespace tamp::runtime
{

RankClocks::RankClocks(const Communicator& communicator)
    : communicator_(communicator), begin_(ask_first_rank(communicator))
{
  take({begin_, begin_});
  differ_ = !std::ranges::all_of(lines_, &ClockLine::is_the_same);
}

void RankClocks::follow(std::int64_t n_steps)
{
  constexpr std::int64_t first_time = 64;
  const bool is_due = n_steps >= first_time && std::has_single_bit(static_cast<std::uint64_t>(n_steps));
  if (differ_ && is_due) take({begin_, ask_first_rank(communicator_)});
}

void RankClocks::take(const ClockLine& own)
{
  lines_ = communicator_.gather_value(own);
}

}  // namespace tamp::runtime
