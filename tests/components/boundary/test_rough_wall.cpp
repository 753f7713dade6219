#include "components/boundary/rough_wall.hpp"

#include <catch2/catch.hpp>

namespace test_rough_wall
{

using namespace tamp::components;
using tamp::Vector;

namespace
{

template <int D>
Vector<D> left(const Vector<D>& arriving, int outside)
{
  return RoughWall{0.5}.velocity<D>(arriving, {1, outside, 0, 0});
}

}  // namespace

TEST_CASE("what runs into a rough wall is stopped, and slowed along it by friction times as much")
{
  const Vector<3> left_below = left<3>({3, -2, 4}, -1);

  CHECK(left_below.isApprox(Vector<3>(3 * 0.8, 0, 4 * 0.8), 1e-15));
  CHECK(left<3>({3, 2, 4}, +1) == left_below);
}

TEST_CASE("friction brings nothing to more than rest")
{
  CHECK(left<2>({0.9, -2}, -1) == Vector<2>::Zero());
  CHECK(left<2>({0, -2}, -1) == Vector<2>::Zero());
}

TEST_CASE("what leaves a rough wall, or moves along without pressing, is free")
{
  CHECK(left<2>({3, 1}, -1) == Vector<2>(3, 1));
  CHECK(left<2>({3, 0}, -1) == Vector<2>(3, 0));
}

}  // namespace test_rough_wall
