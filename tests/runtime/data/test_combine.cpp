#include "runtime/data/combine.hpp"

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cstdint>

namespace tamp::runtime::test_combine
{

namespace
{

struct Part {
  double sum = 0;
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();

  static constexpr auto fields = std::tuple{&Part::sum, &Part::sums};
};

struct Whole {
  std::array<Part, 2> parts;
  std::array<std::array<double, 2>, 2> least{{{9, 9}, {9, 9}}};
  double greatest = -9;
  std::uint64_t bits = 0;

  static constexpr auto fields =
      std::tuple{&Whole::parts, Least{&Whole::least}, Greatest{&Whole::greatest}, AnyBit{&Whole::bits}};
};

struct Forgets {
  double sum = 0;
  double forgotten = 0;

  static constexpr auto fields = std::tuple{&Forgets::sum};
};

struct ListsOneTwice {
  double sum = 0;
  double forgotten = 0;

  static constexpr auto fields = std::tuple{&ListsOneTwice::sum, Least{&ListsOneTwice::sum}};
};

/// Behind `small` there is room for a member that would be missed.
struct HasGap {
  double sum = 0;
  std::int32_t small = 0;

  static constexpr auto fields = std::tuple{&HasGap::sum, &HasGap::small};
};

}  // namespace

TEST_CASE("a struct that is combined lists all of its members, each once", "[data]")
{
  STATIC_REQUIRE(lists_all_members<Part>);
  STATIC_REQUIRE(lists_all_members<Whole>);
  STATIC_REQUIRE_FALSE(lists_all_members<Forgets>);
  STATIC_REQUIRE_FALSE(lists_all_members<ListsOneTwice>);
  STATIC_REQUIRE_FALSE(lists_all_members<HasGap>);
}

TEST_CASE("a struct is combined member by member, each by its rule", "[data]")
{
  Whole whole;
  whole.parts[0] = {1, {1, 2, 3}};
  whole.bits = 4;
  Whole part;
  part.parts[0] = {10, {10, 10, 10}};
  part.parts[1].sum = 5;
  part.least[1][0] = -1;
  part.greatest = 3;
  part.bits = 3;

  combine(whole, part);

  CHECK(whole.parts[0].sum == 11);
  CHECK(whole.parts[0].sums == Eigen::Vector3d(11, 12, 13));
  CHECK(whole.parts[1].sum == 5);
  CHECK(whole.least == std::array<std::array<double, 2>, 2>{{{9, 9}, {-1, 9}}});
  CHECK(whole.greatest == 3);
  CHECK(whole.bits == 7);
}

TEST_CASE("a default part changes nothing", "[data]")
{
  Whole whole;
  whole.parts[1] = {-2, {1, 2, 3}};
  whole.greatest = -4;
  const Whole before = whole;

  combine(whole, Whole{});

  CHECK(whole.parts[1].sum == before.parts[1].sum);
  CHECK(whole.parts[1].sums == before.parts[1].sums);
  CHECK(whole.greatest == before.greatest);
}

}  // namespace tamp::runtime::test_combine
