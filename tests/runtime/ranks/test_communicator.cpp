#include "runtime/ranks/communicator.hpp"

#include <catch2/catch.hpp>

namespace test_communicator
{

using namespace tamp::runtime;

TEST_CASE("sums, least and greatest values over the ranks are known to all", "[ranks]")
{
  const Communicator world = Communicator::world();
  const auto n = static_cast<std::uint64_t>(world.size());
  const auto own = static_cast<std::uint64_t>(world.rank());

  CHECK(world.sum(own + 1) == n * (n + 1) / 2);
  CHECK(world.min(own + 7) == 7);
  CHECK(world.max(own + 7) == n + 6);
  CHECK(world.max(-0.5 * world.rank()) == 0);
}

TEST_CASE("values that each rank knows a few of are known by all as their sums", "[ranks]")
{
  const Communicator world = Communicator::world();
  std::vector<std::uint64_t> own(10, 0), expected;
  for (std::size_t i = 0; i < 10; ++i) {
    expected.push_back(~std::uint64_t{i * i});
    if (static_cast<int>(i) % world.size() == world.rank()) own[i] = ~std::uint64_t{i * i};
  }

  CHECK(world.sum(own) == expected);
}

TEST_CASE("something is so on all ranks only if it is so on each", "[ranks]")
{
  const Communicator world = Communicator::world();

  CHECK(world.all(true));
  CHECK_FALSE(world.all(world.rank() != world.size() - 1));
}

}  // namespace test_communicator
