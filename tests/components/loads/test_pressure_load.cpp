#include "components/loads/pressure_load.hpp"

#include <catch2/catch.hpp>

#include "components/errors.hpp"

namespace test_pressure_load
{

using namespace tamp;
using namespace tamp::components;

TEST_CASE("a pressure is straight between its points and constant beyond them")
{
  const PressureCurve curve({{1, 100}, {3, 500}, {4, 0}});

  CHECK(curve.at(-5) == 100);
  CHECK(curve.at(1) == 100);
  CHECK(curve.at(2) == Approx(300));
  CHECK(curve.at(3) == Approx(500));
  CHECK(curve.at(3.75) == Approx(125));
  CHECK(curve.at(9) == 0);
}

TEST_CASE("pressures without a point, below 0, or at times that do not ascend are refused")
{
  CHECK_THROWS_AS(PressureCurve({}), BadValue);
  CHECK_THROWS_AS(PressureCurve({{0, 1}, {1, -1}}), BadValue);
  CHECK_THROWS_AS(PressureCurve({{0, 1}, {0, 2}}), BadValue);
  CHECK_NOTHROW(PressureCurve({{0, 0}}));
}

TEST_CASE("without a box all of a particle is pressed")
{
  CHECK(PressedBox<3>{}.part_of({1, -7, 1e6}, 0.5, 2) == ByFace<3>::Ones());
}

TEST_CASE("a box that only just holds the top has all matter beneath it pressed from above, and none from the sides")
{
  // The top is at y = 1; particles of 0.1 lie up to it.
  const PressedBox<2> box{{0, 0.999}, {0.25, 1.5}};

  const ByFace<2> at_top = box.part_of({0.05, 0.95}, 0.1, 0.4);
  const ByFace<2> beneath = box.part_of({0.05, 0.65}, 0.1, 0.4);
  const ByFace<2> too_deep = box.part_of({0.05, 0.45}, 0.1, 0.4);
  const ByFace<2> at_end = box.part_of({0.25, 0.95}, 0.1, 0.4);

  CHECK(at_top(1, 1) == Approx(1));
  CHECK(beneath(1, 1) == Approx(1));
  CHECK(too_deep(1, 1) == 0);
  CHECK(at_end(1, 1) == Approx(0.5));
  CHECK(beneath(1, 0) == 0);
  CHECK(at_top(0, 0) == Approx(0.01));
  CHECK(beneath.row(0).isZero(0));
}

TEST_CASE("the force on a node is its pressure against the surface gradient, by the face that looks outwards")
{
  PressureSums<2> sums;
  sums.values << 20, 40, 60, 80;

  CHECK(pressure_force<2>(sums, 2, {0.5, -0.25}) == Vector<2>(-10, 7.5));
  CHECK(pressure_force<2>(sums, 2, {-0.5, 0.25}) == Vector<2>(5, -10));
  CHECK(pressure_force<2>(sums, 0, {1, 1}) == Vector<2>(0, 0));
  CHECK(pressure_force<2>(sums.mirrored(0), 2, {0.5, -0.25}) == Vector<2>(-5, 7.5));
}

}  // namespace test_pressure_load
