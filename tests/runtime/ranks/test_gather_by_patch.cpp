#include "runtime/ranks/gather_by_patch.hpp"

#include <catch2/catch.hpp>

namespace test_gather_by_patch
{

using namespace tamp::runtime;

TEST_CASE("values of patches come to the first rank in the order of the patches", "[ranks]")
{
  const Communicator world = Communicator::world();
  PatchLayout layout({2, {0, 0, 0}, 1, {6, 2, 1}}, {3, 2, 1});
  std::vector<int> ranks;
  ranks.reserve(static_cast<std::size_t>(layout.size()));
  for (int p = 0; p < layout.size(); ++p) ranks.push_back((5 * p + 1) % world.size());
  layout.give_to_ranks(ranks, world.size());
  // Patch p has p values, of which the first has none.
  const std::vector<std::uint64_t> n_values{0, 1, 2, 3, 4, 5};
  std::vector<double> own, all;
  for (const Patch& patch : layout) {
    for (int k = 0; k < patch.id; ++k) {
      all.push_back(10 * patch.id + k);
      if (patch.rank == world.rank()) own.push_back(all.back());
    }
  }

  const std::vector<double> gathered = gather_by_patch(own, n_values, layout, world);

  CHECK(gathered == (world.is_first() ? all : std::vector<double>()));
}

}  // namespace test_gather_by_patch
