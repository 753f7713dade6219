#include <catch2/catch.hpp>
#include <stdexcept>

#include "runtime/file_error.hpp"
#include "runtime/ranks/together.hpp"
#include "runtime/storage/known_by_all.hpp"

using namespace tamp::runtime;

TEST_CASE("a file that fails on one rank is an error on all, and says the same", "[ranks]")
{
  const Communicator world = Communicator::world();
  const int last = world.size() - 1;

  const auto fail = [&] {
    if (world.rank() == last) throw FileError("fields.h5", "no room");
  };

  CHECK_THROWS_AS(together(world, fail), FileError);
  CHECK_THROWS_WITH(together(world, fail), "fields.h5: no room");
}

TEST_CASE("a rank that fails by itself throws what it has, and the others tell which rank it was", "[ranks]")
{
  const Communicator world = Communicator::world();

  const auto fail = [&] {
    if (world.is_first()) throw std::invalid_argument("two for three");
  };

  CHECK_THROWS_WITH(together(world, fail), world.is_first() ? "two for three" : "rank 0: two for three");
}

TEST_CASE("work that succeeds on all ranks throws on none", "[ranks]")
{
  int n_done = 0;

  CHECK_NOTHROW(together(Communicator::world(), [&] { ++n_done; }));
  CHECK(n_done == 1);
}

TEST_CASE("values that each rank knows a few of are known by all", "[ranks]")
{
  const Communicator world = Communicator::world();
  std::vector<std::uint64_t> own(10, 0), expected;
  for (std::size_t i = 0; i < 10; ++i) {
    expected.push_back(i * i);
    if (static_cast<int>(i) % world.size() == world.rank()) own[i] = i * i;
  }

  CHECK(known_by_all(own, world) == expected);
}
