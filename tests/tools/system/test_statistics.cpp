#include <catch2/catch.hpp>

#include "tools/system/statistics.hpp"

namespace test_statistics
{

using namespace tamp::tools;

TEST_CASE("quartiles lie between the values in order")
{
  const Quartiles q = quartiles({5, 1, 3, 2, 4});

  CHECK(q.lower == 2);
  CHECK(q.median == 3);
  CHECK(q.upper == 4);
  CHECK(quartiles({1, 2}).median == 1.5);
  CHECK(quartiles({7}).upper == 7);
}

TEST_CASE("the median of nothing is 0, and that of an even number of values lies between two")
{
  CHECK(median({}) == 0);
  CHECK(median({4, 1, 3, 2}) == 2.5);
}

}  // namespace test_statistics
