#include <catch2/catch.hpp>

#include <numbers>

#include "components/geometry/ball.hpp"
#include "components/geometry/cone.hpp"
#include "components/geometry/set_operations.hpp"
#include "components/geometry/turned_section.hpp"

namespace test_turned_section
{

using namespace tamp;
using namespace tamp::components;

constexpr double pi = std::numbers::pi;

TEST_CASE("the section of what is round about the axis makes what it was cut from")
{
  const Solid<3> ball(Ball<3>{{0, 1, 0}, 0.5}), cone(Cone{{0, 0, 0}, {0, 2, 0}, 0.25, 1});
  const Solid<3> drilled(Difference<3>{ball, {Solid<3>(Cylinder{{0, 0, 0}, {0, 3, 0}, 0.2})}});

  const TurnedVolumes of_ball = volumes_of_turning(ball), of_cone = volumes_of_turning(cone);
  const TurnedVolumes of_drilled = volumes_of_turning(drilled);

  CHECK(of_ball.turned == of_ball.solid);
  CHECK(of_ball.apart == 0);
  CHECK(of_ball.solid == Approx(pi / 6).epsilon(3e-3));
  CHECK(of_cone.turned == of_cone.solid);
  CHECK(of_cone.apart == 0);
  CHECK(of_cone.solid == Approx(7 * pi / 8).epsilon(3e-3));
  CHECK(of_drilled.turned == of_drilled.solid);
  CHECK(of_drilled.apart == 0);
}

TEST_CASE("the section of what is not round makes another volume, and both are found")
{
  const Solid<3> square(Box<3>{{-1, 0, -1}, {1, 3, 1}}), beside(Ball<3>{{2, 0, 0}, 0.5}), behind(Ball<3>{{0, 0, 4}, 1});

  const TurnedVolumes of_square = volumes_of_turning(square), of_beside = volumes_of_turning(beside);
  const TurnedVolumes of_behind = volumes_of_turning(behind);

  CHECK(of_square.solid == Approx(12).epsilon(5e-3));
  CHECK(of_square.turned == Approx(3 * pi).epsilon(5e-3));
  CHECK(of_beside.solid == Approx(pi / 6).epsilon(2e-2));
  CHECK(of_beside.turned == Approx(pi * pi).epsilon(5e-3));
  CHECK(of_behind.solid == Approx(4 * pi / 3).epsilon(2e-2));
  CHECK(of_behind.turned == 0);
}

TEST_CASE("the section of a cylinder across the axis may have its volume, and is apart from it")
{
  const Solid<3> across(Cylinder{{-0.5, 1, 0}, {0.5, 1, 0}, 0.5});

  const TurnedVolumes volumes = volumes_of_turning(across);

  CHECK(volumes.turned == Approx(volumes.solid).epsilon(1e-2));
  CHECK(volumes.apart > 0.1 * volumes.solid);
}

}  // namespace test_turned_section
