#include <catch2/catch.hpp>
#include <stdexcept>

#include "runtime/file_error.hpp"
#include "runtime/ranks/on_all_ranks.hpp"

namespace test_on_all_ranks
{

using namespace tamp::runtime;

TEST_CASE("a file that fails on one rank is an error on all, and says the same", "[ranks]")
{
  const Communicator world = Communicator::world();
  const int last = world.size() - 1;

  const auto fail = [&] {
    if (world.rank() == last) throw FileError("fields.h5", "no room");
  };

  CHECK_THROWS_AS(on_all_ranks(world, fail), FileError);
  CHECK_THROWS_WITH(on_all_ranks(world, fail), "fields.h5: no room");
}

TEST_CASE("a rank that fails by itself throws what it has, and the others tell which rank it was", "[ranks]")
{
  const Communicator world = Communicator::world();

  const auto fail = [&] {
    if (world.is_first()) throw std::invalid_argument("two for three");
  };

  CHECK_THROWS_WITH(on_all_ranks(world, fail), world.is_first() ? "two for three" : "rank 0: two for three");
}

TEST_CASE("work that succeeds on all ranks throws on none", "[ranks]")
{
  int n_done = 0;

  CHECK_NOTHROW(on_all_ranks(Communicator::world(), [&] { ++n_done; }));
  CHECK(n_done == 1);
}

}  // namespace test_on_all_ranks
