#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "components/errors.hpp"
#include "components/geometry/ball.hpp"
#include "components/geometry/cone.hpp"
#include "components/geometry/ogive.hpp"
#include "components/geometry/revolved.hpp"
#include "components/geometry/solid.hpp"
#include "tests/components/geometry/counted_volume.hpp"

namespace test_round_solids
{

using namespace tamp;
using namespace tamp::components;
using tamp::test::counted_volume;

namespace
{

constexpr double pi = std::numbers::pi;

/// Do both hold the same of 20000 random points of a cube of half an edge `reach`?
template <class Reference>
bool agree(const Solid<3>& solid, double reach, Reference&& reference)
{
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  for (int i = 0; i < 20000; ++i) {
    const Vector<3> x(coordinate(engine), coordinate(engine), coordinate(engine));
    if (solid.contains(x) != reference(x)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a cone holds what is nearer to its axis than its radius there")
{
  const Solid<3> cone(Cone{{0, 0, -1}, {0, 0, 2}, 1.5, 0});

  CHECK(agree(cone, 2,
              [](const Vector<3>& x) { return x[2] >= -1 && x[2] < 2 && std::hypot(x[0], x[1]) < 0.5 * (2 - x[2]); }));
  CHECK(cone.volume().value == Approx(pi * 1.5 * 1.5 * 3 / 3));
  CHECK(cone.volume().is_exact());
}

TEST_CASE("a truncated cone of equal radii is a cylinder")
{
  const Vector<3> first(0.1, 0.2, 0.3), second(1, -1, 0.5);
  const Solid<3> cone(Cone{first, second, 0.7, 0.7});
  const Solid<3> cylinder(Cylinder{first, second, 0.7});

  CHECK(agree(cone, 2, [&](const Vector<3>& x) { return cylinder.contains(x); }));
  CHECK(cone.volume().value == Approx(cylinder.volume().value));
}

TEST_CASE("an ogive as long as its radius is half of a ball")
{
  const Solid<3> ogive(Ogive{{0, 0, 1.5}, {0, 0, 0}, 1.5});

  CHECK(agree(ogive, 2, [](const Vector<3>& x) { return x[2] > 0 && x.norm() < 1.5; }));
  CHECK(ogive.volume().value == Approx(2.0 / 3 * pi * std::pow(1.5, 3)));
  CHECK(ogive.reach({1, 0, 1}) == Approx(1.5 * std::sqrt(2.0)));
}

TEST_CASE("an ogive lies within its two arcs")
{
  // Radius 1, length 3: arcs of radius (1 + 9) / 2 about points 4 beyond the axis.
  const Solid<3> ogive(Ogive{{-3, 0, 0}, {0, 0, 0}, 1});

  CHECK(agree(ogive, 3, [](const Vector<3>& x) {
    return x[0] < 0 && x[0] > -3 && std::hypot(x[0], std::hypot(x[1], x[2]) + 4) < 5;
  }));
  CHECK(counted_volume(ogive, 150) == Approx(ogive.volume().value).epsilon(2e-3));
  CHECK(ogive.bounding_box().lower[0] == Approx(-3));
  CHECK(ogive.bounding_box().upper[1] == Approx(1));
}

TEST_CASE("a profile of equal radii is a cylinder, and one with a tip of its own length's curvature a paraboloid")
{
  const Solid<3> cylinder(Revolved({0, 0, -1}, {0, 0, 2}, {{0, 0.8}, {1.5, 0.8}}));
  const Solid<3> paraboloid(Revolved({-1, 0, 0}, {1, 0, 0}, {{0, 0}, {2, 1}}, 0.25));

  CHECK(
      agree(cylinder, 2, [](const Vector<3>& x) { return x[2] >= -1 && x[2] < 0.5 && std::hypot(x[0], x[1]) < 0.8; }));
  // r^2 grows by 2 R = 0.5 a metre all the way: it is 1 at 2 m.
  CHECK(agree(paraboloid, 2, [](const Vector<3>& x) {
    return x[0] >= -1 && x[0] < 1 && x[1] * x[1] + x[2] * x[2] < 0.5 * (x[0] + 1);
  }));
  CHECK(cylinder.volume().value == Approx(pi * 0.64 * 1.5));
  CHECK(paraboloid.volume().value == Approx(pi * 0.5 * 2));
}

TEST_CASE("a tip has the curvature that it is given")
{
  const Revolved body({0, 0, 0}, {1, 0, 0}, {{0, 0}, {1, 0.6}, {2, 0.6}}, 0.1);

  const double depth = 1e-6, radius = std::sqrt(body.radius_squared(depth));

  CHECK((radius * radius + depth * depth) / (2 * depth) == Approx(0.1).epsilon(1e-4));
}

TEST_CASE("a profile passes through its points, rises and falls only with them, and has their volume")
{
  const std::vector<ProfilePoint> profile{{0, 0.1}, {0.5, 0.8}, {0.7, 1}, {1.4, 0.4}, {2, 0.4}};
  const Revolved body({0, 0, 0}, {0, 0, 1}, profile);
  const Solid<3> solid(body);

  for (const ProfilePoint& p : profile) CHECK(body.radius_squared(p.along) == Approx(p.radius * p.radius));
  double integral = 0, before = 0;
  bool rises = true, falls = true;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double along = 2 * (i + 0.5) / n, squared = body.radius_squared(along);
    integral += pi * squared * 2 / n;
    if (along < 0.7) rises = rises && squared >= before;
    if (along > 0.7 + 2.0 / n) falls = falls && squared <= before + 1e-12;
    before = squared;
  }
  CHECK(rises);
  CHECK(falls);
  CHECK(solid.volume().value == Approx(integral).epsilon(1e-6));
}

TEST_CASE("the box of a tilted body of revolution is tight around its points")
{
  const Vector<3> axis = Vector<3>(1, 2, -1).normalized();
  const Solid<3> solid(Revolved({0.2, 0, 0}, axis, {{0, 0}, {1, 0.6}, {1.5, 0.2}}, 0.1));
  const Box<3> box = solid.bounding_box();
  Vector<3> lower = box.upper, upper = box.lower;

  std::mt19937 engine(3);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  bool within = true;
  for (int i = 0; i < 400000; ++i) {
    const Vector<3> x(coordinate(engine), coordinate(engine), coordinate(engine));
    if (!solid.contains(x)) continue;
    within = within && box.contains(x);
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }

  CHECK(within);
  CHECK((lower - box.lower).cwiseAbs().maxCoeff() < 0.08);
  CHECK((upper - box.upper).cwiseAbs().maxCoeff() < 0.08);
}

TEST_CASE("round solids that are none are refused")
{
  const Vector<3> o(0, 0, 0), z(0, 0, 1);

  CHECK_THROWS_AS(Solid<3>(Cone{o, z, 0, 0}), BadValue);
  CHECK_THROWS_AS(Solid<3>(Cone{o, z, -1, 1}), BadValue);
  CHECK_THROWS_AS(Solid<3>(Cone{o, o, 1, 1}), BadValue);
  CHECK_THROWS_AS(Solid<3>(Ogive{o, z, 1.1}), BadValue);
  CHECK_THROWS_AS(Solid<3>(Ogive{o, o, 0.1}), BadValue);
  CHECK_THROWS_AS(Revolved(o, o, {{0, 1}, {1, 1}}), BadValue);
  CHECK_THROWS_AS(Revolved(o, z, {{0, 1}}), BadValue);
  CHECK_THROWS_AS(Revolved(o, z, {{0, 0}, {1, 0}}), BadValue);
  CHECK_THROWS_AS(Revolved(o, z, {{0, 1}, {1, -1}}), BadValue);
  CHECK_THROWS_AS(Revolved(o, z, {{0, 1}, {1, 0}, {2, 1}}), BadValue);
  CHECK_THROWS_AS(Revolved(o, z, {{0, 1}, {1, 1}}, 0.5), BadValue);
  CHECK_THROWS_AS(Revolved(o, z, {{0, 0}, {1, 1}}, 1.6), BadValue);
}

TEST_CASE("a profile that goes backward is reported with its row")
{
  try {
    const Revolved body({0, 0, 0}, {0, 0, 1}, {{0, 1}, {2, 1}, {1, 1}});
    FAIL("it was taken");
  } catch (const BadValue& bad) {
    CHECK(bad.row == 2);
    CHECK_THAT(bad.found, Catch::Contains("goes from 2.0"));
  }
}

}  // namespace test_round_solids
