#include "components/packs.hpp"

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace test_packs
{

using namespace tamp;

namespace
{

template <class Number>
struct PairOf {
  Number first, second;

  static constexpr auto fields = std::tuple(&PairOf::first, &PairOf::second);
};

constexpr std::size_t n_tile = 4 * n_lanes;

}  // namespace

TEST_CASE("columns give back what was written to them alone, among neighbours and in packs")
{
  Columns<PairOf, n_tile> columns;
  for (std::size_t i = 0; i < n_tile; ++i) {
    const auto x = static_cast<double>(i);
    columns.set(i, {x, -x});
  }
  // Neighbours need not start at a multiple of the lanes.
  const std::size_t first = n_lanes + 1;
  const PairOf<Lanes> neighbours = columns.lanes_at(first);
  for (std::size_t l = 0; l < n_lanes; ++l) {
    CHECK(neighbours.first[l] == static_cast<double>(first + l));
    CHECK(neighbours.second[l] == -static_cast<double>(first + l));
  }
  columns.set_lanes(first, {10.0 * neighbours.first, 10.0 * neighbours.second});

  Pack backwards{.of = {}, .n = n_lanes};
  for (std::size_t l = 0; l < n_lanes; ++l) backwards.of[l] = static_cast<std::uint32_t>(n_tile - 1 - l);
  const PairOf<Lanes> last = columns.at(backwards);
  for (std::size_t l = 0; l < n_lanes; ++l) CHECK(last.first[l] == static_cast<double>(n_tile - 1 - l));
  columns.set(backwards, {100.0 * last.first, 100.0 * last.second});

  for (std::size_t i = 0; i < n_tile; ++i) {
    const bool among_neighbours = i >= first && i < first + n_lanes, in_pack = i >= n_tile - n_lanes;
    const double factor = (among_neighbours ? 10 : 1) * (in_pack ? 100 : 1);
    CHECK(columns.at(i).first == factor * static_cast<double>(i));
    CHECK(columns.last(i) == -factor * static_cast<double>(i));
  }
}

TEST_CASE("the packs of a list hold each of its particles once, and repeat the last where they end")
{
  PackedList<n_tile> list;
  std::vector<std::size_t> expected;
  for (std::size_t i = 0; i < n_tile; ++i) {
    list.add_if(i % 3 == 1, i);
    if (i % 3 == 1) expected.push_back(i);
  }
  std::vector<std::size_t> found;
  list.for_each_pack([&](const Pack& pack) {
    for (std::size_t l = 0; l < n_lanes; ++l) {
      if (l < pack.n) {
        found.push_back(pack.of[l]);
      } else {
        CHECK(pack.of[l] == pack.of[pack.n - 1]);
      }
    }
  });
  CHECK(found == expected);

  list.keep_if([](std::size_t i) { return i >= n_tile / 2; });
  std::erase_if(expected, [](std::size_t i) { return i < n_tile / 2; });
  found.clear();
  list.for_each([&](std::size_t i) { found.push_back(i); });
  CHECK(found == expected);
}

TEST_CASE("a condition is counted over the first lanes")
{
  const Lanes number = each_lane([](std::size_t l) { return static_cast<double>(l); });
  for (std::size_t n = 0; n <= n_lanes; ++n) {
    CHECK(count(first_lanes(n)) == n);
    CHECK(count(number > 0.0 && first_lanes(n)) == (n > 0 ? n - 1 : 0));
  }
}

}  // namespace test_packs
