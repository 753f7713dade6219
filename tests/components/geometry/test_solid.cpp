#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "components/errors.hpp"
#include "components/geometry/ball.hpp"
#include "components/geometry/cone.hpp"
#include "components/geometry/rotations.hpp"
#include "components/geometry/solid.hpp"
#include "tests/components/geometry/counted_volume.hpp"

namespace test_solid
{

using namespace tamp;
using namespace tamp::components;
using tamp::test::counted_volume;

TEST_CASE("a box holds its lower faces and not its upper ones")
{
  const Solid<2> box(Box<2>{{1, 2}, {3, 5}});

  CHECK(box.contains({1, 2}));
  CHECK(box.contains({2.999, 4.999}));
  CHECK_FALSE(box.contains({3, 4}));
  CHECK_FALSE(box.contains({2, 5}));
  CHECK_FALSE(box.contains({0.999, 4}));
  CHECK(box.volume().value == 6);
}

TEST_CASE("two boxes that share a face share no point and leave none out")
{
  const Solid<3> left(Box<3>{{0, 0, 0}, {1, 1, 1}}), right(Box<3>{{1, 0, 0}, {2, 1, 1}});

  for (const double x : {0.0, 0.5, 1.0, 1.5, 1.999}) {
    CHECK(left.contains({x, 0.5, 0.5}) != right.contains({x, 0.5, 0.5}));
  }
}

TEST_CASE("a ball holds what is closer to its centre than its radius")
{
  const Solid<3> ball(Ball<3>{{1, 0, 0}, 2});

  CHECK(ball.contains({1 + 1.15, 1.15, 1.15}));
  CHECK_FALSE(ball.contains({1 + 1.16, 1.16, 1.16}));
  CHECK(ball.bounding_box().lower == Vector<3>(-1, -2, -2));
  CHECK(ball.bounding_box().upper == Vector<3>(3, 2, 2));
}

TEST_CASE("a rotated box holds the points of the unrotated one turned about its centre")
{
  const double angle = std::numbers::pi / 6;
  const Solid<2> block(RotatedBox<2>{{10, 20}, {4, 2}, plane_rotation<2>(angle)});
  const auto turned = [&](double along, double up) -> Vector<2> {
    return {10 + along * std::cos(angle) - up * std::sin(angle), 20 + along * std::sin(angle) + up * std::cos(angle)};
  };

  CHECK(block.contains(turned(1.99, 0.99)));
  CHECK(block.contains(turned(-1.99, -0.99)));
  CHECK_FALSE(block.contains(turned(2.01, 0)));
  CHECK_FALSE(block.contains(turned(0, -1.01)));
  const double half_width = 2 * std::cos(angle) + 1 * std::sin(angle);
  CHECK(block.bounding_box().upper[0] == Approx(10 + half_width));
  CHECK(block.bounding_box().lower[0] == Approx(10 - half_width));
}

TEST_CASE("a tilted cylinder ends at its ends, at its radius and at its bounding box")
{
  const Vector<3> first(1, 1, 1), second(4, 5, 1);  // axis (0.6, 0.8, 0), length 5
  const Solid<3> cylinder(Cylinder{first, second, 2});

  CHECK(cylinder.contains(first + Vector<3>(0, 0, 1.99)));
  CHECK_FALSE(cylinder.contains(first + Vector<3>(0, 0, 2.01)));
  CHECK(cylinder.contains(second - 0.01 * Vector<3>(0.6, 0.8, 0)));
  CHECK_FALSE(cylinder.contains(second + 0.01 * Vector<3>(0.6, 0.8, 0)));
  CHECK_FALSE(cylinder.contains(first - 0.01 * Vector<3>(0.6, 0.8, 0)));
  const Box<3> box = cylinder.bounding_box();
  CHECK((box.lower - Vector<3>(1 - 2 * 0.8, 1 - 2 * 0.6, 1 - 2)).norm() < 1e-14);
  CHECK((box.upper - Vector<3>(4 + 2 * 0.8, 5 + 2 * 0.6, 1 + 2)).norm() < 1e-14);
}

TEST_CASE("the volume of a solid is that of the points it contains")
{
  const Matrix<3> tilt = plane_rotation<3>(0.4);
  const Solid<2> disk(Ball<2>{{0.1, 0.2}, 0.7}), block(RotatedBox<2>{{0, 0}, {2, 1}, plane_rotation<2>(0.3)});
  const Solid<3> sphere(Ball<3>{{0.1, 0.2, 0.3}, 0.7}), brick(RotatedBox<3>{{0, 0, 0}, {2, 1, 0.5}, tilt});
  const Solid<3> cylinder(Cylinder{{0, 0, 0}, {1, 2, 3}, 0.6});

  CHECK(counted_volume(disk, 1000) == Approx(disk.volume().value).epsilon(1e-3));
  CHECK(counted_volume(block, 1000) == Approx(block.volume().value).epsilon(1e-3));
  CHECK(counted_volume(sphere, 120) == Approx(sphere.volume().value).epsilon(2e-3));
  CHECK(counted_volume(brick, 120) == Approx(brick.volume().value).epsilon(2e-3));
  CHECK(counted_volume(cylinder, 120) == Approx(cylinder.volume().value).epsilon(2e-3));
}

TEST_CASE("a shape without a volume, or with numbers that are none, is refused")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Matrix<2> stretch = 2 * Matrix<2>::Identity();
  Matrix<2> reflection = Matrix<2>::Identity();
  reflection(0, 0) = -1;

  CHECK_THROWS_AS(Solid<2>(Box<2>{{0, 0}, {1, 0}}), BadValue);
  CHECK_THROWS_AS(Solid<2>(Box<2>{{0, 0}, {1, nan}}), BadValue);
  CHECK_THROWS_AS(Solid<3>(Ball<3>{{0, 0, 0}, 0}), BadValue);
  CHECK_THROWS_AS(Solid<2>(Ball<2>{{nan, 0}, 1}), BadValue);
  CHECK_THROWS_AS(Solid<2>(RotatedBox<2>{{0, 0}, {1, -1}, plane_rotation<2>(0.1)}), BadValue);
  CHECK_THROWS_AS(Solid<2>(RotatedBox<2>{{0, 0}, {1, 1}, stretch}), BadValue);
  CHECK_THROWS_AS(Solid<2>(RotatedBox<2>{{0, 0}, {1, 1}, reflection}), BadValue);
  CHECK_THROWS_AS(Solid<3>(Cylinder{{1, 1, 1}, {1, 1, 1}, 1}), BadValue);
}

}  // namespace test_solid
