#include "components/boundary/rough_wall.hpp"

#include <catch2/catch.hpp>

namespace test_rough_wall
{

using namespace tamp::components;
using tamp::Vector;

TEST_CASE("what runs into a rough wall is stopped, and slowed along it by friction times as much")
{
  const Vector<3> left = velocity_on_rough_wall<3>({3, -2, 4}, 1, -1, 0.5);

  CHECK(left.isApprox(Vector<3>(3 * 0.8, 0, 4 * 0.8), 1e-15));
  CHECK(velocity_on_rough_wall<3>({3, 2, 4}, 1, +1, 0.5) == left);
}

TEST_CASE("friction brings nothing to more than rest")
{
  CHECK(velocity_on_rough_wall<2>({0.9, -2}, 1, -1, 0.5) == Vector<2>::Zero());
  CHECK(velocity_on_rough_wall<2>({0, -2}, 1, -1, 0.5) == Vector<2>::Zero());
}

TEST_CASE("what leaves a rough wall, or moves along without pressing, is free")
{
  CHECK(velocity_on_rough_wall<2>({3, 1}, 1, -1, 0.5) == Vector<2>(3, 1));
  CHECK(velocity_on_rough_wall<2>({3, 0}, 1, -1, 0.5) == Vector<2>(3, 0));
}

}  // namespace test_rough_wall
