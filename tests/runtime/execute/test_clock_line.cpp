#include "runtime/execute/clock_line.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>

namespace tamp::runtime::test_clock_line
{

TEST_CASE("the shortest round trip tells what another clock shows, and how surely", "[profile]")
{
  // The other clock is 5000 ahead. The second trip took 40 there and 60 back, the others longer on one way.
  const std::array<RoundTrip, 3> trips{{{1000, 6900, 1950}, {2000, 7040, 2100}, {3000, 8010, 3500}}};

  const ClockPair pair = shortest_of(trips);

  CHECK(pair.own == 2050);
  CHECK(pair.first_rank == 7040);
  CHECK(pair.uncertainty == 50);
}

TEST_CASE("however a trip's time is shared by its ways, the clock is within the uncertainty", "[profile]")
{
  constexpr std::uint64_t ahead = 700;
  for (std::uint64_t there = 0; there <= 101; ++there) {
    const std::array<RoundTrip, 1> trip{{{100, 100 + there + ahead, 201}}};

    const ClockPair pair = shortest_of(trip);

    const auto wrong = static_cast<std::int64_t>(pair.first_rank - pair.own - ahead);
    CHECK(std::abs(wrong) <= static_cast<std::int64_t>(pair.uncertainty));
  }
}

TEST_CASE("a clock that drifts is right at both ends and in between", "[profile]")
{
  // Behind by 10^12 at first, and faster by a thousandth than the first rank's, over 10^15 ticks: days.
  const ClockPair begin{2'000'000'000'000, 1'000'000'000'000, 20},
      end{1'002'000'000'000'000, 1'000'000'000'000'000, 30};

  const ClockLine line(begin, end);

  CHECK(line.first_rank(begin.own) == begin.first_rank);
  CHECK(line.first_rank(end.own) == end.first_rank);
  CHECK(line.first_rank(502'000'000'000'000) == 500'500'000'000'000);
  CHECK(line.uncertainty() == 30);
}

TEST_CASE("clocks that nothing tells apart are the same, and so are those of one moment", "[profile]")
{
  const ClockLine same({1000, 1015, 20}, {900'000, 899'990, 10});
  const ClockLine at_once({1000, 5000, 20}, {1000, 5000, 20});

  CHECK(same.first_rank(123'456) == 123'456);
  CHECK(same.uncertainty() == 20);
  CHECK(at_once.first_rank(990) == 4990);
}

TEST_CASE("ranks of one machine find that their clocks agree", "[profile][ranks]")
{
  const Communicator ranks = Communicator::world();

  const ClockPair begin = ask_first_rank(ranks);
  const ClockLine line(begin, ask_first_rank(ranks));

  const auto off = static_cast<std::int64_t>(line.first_rank(begin.own) - begin.own);
  CHECK(std::abs(off) <= static_cast<std::int64_t>(line.uncertainty()));
  CHECK((line.uncertainty() == 0) == ranks.is_first());
}

}  // namespace tamp::runtime::test_clock_line
