#include "components/contact/wall_gaps.hpp"

#include <catch2/catch.hpp>
#include <vector>

namespace test_wall_gaps
{

using namespace tamp::components;
using tamp::Matrix;
using tamp::Vector;

namespace
{

/// A block of 6 by 6 nodes from (-1, -1), one metre apart.
GridBlock<2> block()
{
  return {Vector<2>(-1, -1), 1, {6, 6}, {1, 6}};
}

std::vector<WallGaps<2>> gaps_of(const Vector<2>& position, const Matrix<2>& deformation, std::vector<PlaneWall> walls)
{
  std::vector<WallGaps<2>> sums(36);
  const std::vector<Vector<2>> positions{position};
  const std::vector<Matrix<2>> gradients{deformation};
  const auto interpolation = Interpolation<2>::make("gimp", 2, Plane::slab);
  add_wall_gaps<2>(*interpolation, block(), {positions, gradients}, 0.5, walls, sums.data());
  return sums;
}

}  // namespace

TEST_CASE("the gap of a particle to a wall is that of its edge, less what rows behind the first take")
{
  const double place = GENERATE(0.4, 0.25);
  const PlaneWall below{1, -1, 0}, left{0, -1, 0}, above{1, 1, 4};
  Matrix<2> flattened = Matrix<2>::Identity();
  flattened(1, 1) = 0.5;

  const auto gaps = gaps_of({1, place}, flattened, {below, left, above});

  const WallGaps<2>& node = gaps[2 + 6];
  REQUIRE(node.weight(below) > 0);
  CHECK(node.gap(below) == Approx(place - 0.5 * 0.25 - 0.035 * 0.25));
  CHECK(node.gap(left) == Approx(1 - 0.535 * 0.5));
  CHECK(node.weight(above) == 0);
}

TEST_CASE("nodes that no particle near the wall reaches have no gap to it")
{
  const PlaneWall below{1, -1, 0};

  const auto far = gaps_of({1, 2.2}, Matrix<2>::Identity(), {below});

  for (const WallGaps<2>& node : far) CHECK(node.weight(below) == 0);
}

}  // namespace test_wall_gaps
