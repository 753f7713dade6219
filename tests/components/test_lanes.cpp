#include "components/lanes.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <numeric>
#include <vector>

namespace test_lanes
{

using namespace tamp;

TEST_CASE("numbers that stand one after the other at places of each lane's own are read side by side")
{
  constexpr std::size_t n = 19;
  std::array<std::array<double, n>, n_lanes> rows;
  for (std::size_t l = 0; l < n_lanes; ++l) std::iota(rows[l].begin(), rows[l].end(), 100.0 * static_cast<double>(l));

  const std::array<Lanes, n> columns = side_by_side(rows);
  const std::array<double, n> alone = side_by_side<n>(std::array{static_cast<const double*>(rows[1].data())});

  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t l = 0; l < n_lanes; ++l) CHECK(columns[i][l] == rows[l][i]);
    CHECK(alone[i] == rows[1][i]);
  }
}

TEST_CASE("the last lanes of a span repeat its last number, and are written back no further than it goes")
{
  std::vector<double> numbers(n_lanes + 1);
  std::iota(numbers.begin(), numbers.end(), 1.0);

  const Lanes tail = lanes_at(numbers, n_lanes);
  set_lanes(numbers, 0, 10 * lanes_at(numbers, 0));
  set_lanes(std::span(numbers).first(n_lanes), n_lanes - 1, Lanes(-1));

  CHECK(tail[0] == static_cast<double>(n_lanes + 1));
  CHECK(tail[n_lanes - 1] == static_cast<double>(n_lanes + 1));
  CHECK(numbers[0] == 10);
  CHECK(numbers[n_lanes - 1] == -1);
  CHECK(numbers[n_lanes] == static_cast<double>(n_lanes + 1));
}

TEST_CASE("what is behind the point is cut off in both directions")
{
  const Lanes x([](auto l) { return (l % 2 == 0 ? 1 : -1) * (static_cast<double>(l) + 0.75); });

  const Lanes whole = truncated(x);

  for (std::size_t l = 0; l < n_lanes; ++l) {
    CHECK(whole[l] == truncated(double{x[l]}));
    CHECK(whole[l] == (l % 2 == 0 ? 1 : -1) * static_cast<double>(l));
  }
}

}  // namespace test_lanes
