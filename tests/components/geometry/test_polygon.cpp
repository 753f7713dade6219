#include <catch2/catch.hpp>

#include <random>

#include "components/errors.hpp"
#include "components/geometry/polygon.hpp"
#include "components/geometry/solid.hpp"

namespace test_polygon
{

using namespace tamp;
using namespace tamp::components;

TEST_CASE("a polygon holds what lies within its edges, also where it is hollow")
{
  // A square of edge 2 with its right third cut in by a wedge to the middle.
  const Solid<2> notched(Polygon({{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}}));
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> coordinate(-0.5, 2.5);
  bool agree = true;

  for (int i = 0; i < 20000; ++i) {
    const Vector<2> x(coordinate(engine), coordinate(engine));
    const bool in_square = x[0] > 0 && x[0] < 2 && x[1] > 0 && x[1] < 2;
    const bool in_wedge = x[0] - 1 > std::abs(x[1] - 1);
    agree = agree && notched.contains(x) == (in_square && !in_wedge);
  }

  CHECK(agree);
  CHECK(notched.volume().value == Approx(3));
  CHECK(notched.bounding_box().upper == Vector<2>(2, 2));
}

TEST_CASE("the sense of a polygon's corners does not matter")
{
  const Solid<2> one(Polygon({{0, 0}, {2, 0}, {0, 1}})), other(Polygon({{0, 1}, {2, 0}, {0, 0}}));

  CHECK(one.volume().value == other.volume().value);
  CHECK(one.contains({0.5, 0.5}));
  CHECK(other.contains({0.5, 0.5}));
}

TEST_CASE("two polygons that share an edge share no point and leave none out")
{
  const Polygon left({{0, 0}, {0.3, 0}, {0.7, 1}, {0, 1}}), right({{0.3, 0}, {1, 0}, {1, 1}, {0.7, 1}});
  bool one_each = true;

  for (int i = 0; i < 1000; ++i) {
    const double y = i / 1000.0;
    const Vector<2> on_edge(0.3 + y * 0.4, y);
    one_each = one_each && left.contains(on_edge) != right.contains(on_edge);
  }

  CHECK(one_each);
  CHECK(left.contains({0, 0}));
  CHECK_FALSE(right.contains({1, 0.5}));
}

TEST_CASE("a polygon that crosses or touches itself is refused")
{
  CHECK_THROWS_AS(Polygon({{0, 0}, {1, 0}}), BadValue);
  CHECK_THROWS_AS(Polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), BadValue);
  CHECK_THROWS_AS(Polygon({{0, 0}, {2, 0}, {1, 0}}), BadValue);
  CHECK_THROWS_AS(Polygon({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}), BadValue);
  CHECK_THROWS_AS(Polygon({{0, 0}, {1, 0}, {1, 0}, {1, 1}}), BadValue);
}

TEST_CASE("an extruded polygon is the polygon between its two heights")
{
  const Solid<3> fin(ExtrudedPolygon{Polygon({{0, 0}, {2, 0}, {0, 1}}), -0.5, 1.5});

  CHECK(fin.contains({0.5, 0.5, -0.5}));
  CHECK_FALSE(fin.contains({0.5, 0.5, 1.5}));
  CHECK_FALSE(fin.contains({1.5, 0.5, 0}));
  CHECK(fin.volume().value == Approx(2));
  CHECK(fin.bounding_box().lower == Vector<3>(0, 0, -0.5));
  CHECK_THROWS_AS(Solid<3>(ExtrudedPolygon{Polygon({{0, 0}, {2, 0}, {0, 1}}), 1, 1}), BadValue);
}

}  // namespace test_polygon
