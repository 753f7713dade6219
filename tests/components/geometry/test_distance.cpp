#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "components/geometry/ball.hpp"
#include "components/geometry/closed_mesh.hpp"
#include "components/geometry/cone.hpp"
#include "components/geometry/ogive.hpp"
#include "components/geometry/polygon.hpp"
#include "components/geometry/revolved.hpp"
#include "components/geometry/rotations.hpp"
#include "components/geometry/section.hpp"
#include "components/geometry/set_operations.hpp"
#include "components/geometry/solid.hpp"
#include "components/geometry/transformed.hpp"

namespace test_distance
{

using namespace tamp;
using namespace tamp::components;

namespace
{

template <int D>
using Named = std::vector<std::pair<std::string, Solid<D>>>;

const Polygon& star()
{
  static const Polygon polygon(
      {{0, 2}, {-0.5, 0.5}, {-2, 0.3}, {-0.8, -0.6}, {-1, -2}, {0.3, -0.9}, {1.5, -1.2}, {0.7, 0.4}});
  return polygon;
}

Named<2> solids(std::integral_constant<int, 2>)
{
  const Solid<3> rod(
      Union<3>{{Solid<3>(Ogive{{0, -1, 0}, {0, 1, 0}, 0.7}), Solid<3>(Cylinder{{0, 1, 0}, {0, 2, 0}, 0.7})}});
  return {{"box", Solid<2>(Box<2>{{-1, -0.5}, {0.7, 1.5}})},
          {"rotated box", Solid<2>(RotatedBox<2>{{0.2, 0.1}, {2, 0.6}, plane_rotation<2>(0.7)})},
          {"ball", Solid<2>(Ball<2>{{0.3, -0.2}, 1.1})},
          {"star", Solid<2>(star())},
          {"triangle the other way round", Solid<2>(Polygon({{-1, -1}, {0, 1.3}, {1.2, -0.4}}))},
          {"section of a rod", Solid<2>(Section{rod})},
          {"turned", Solid<2>(Transformed<2>{Solid<2>(star()), plane_rotation<2>(1), {0.5, 0.2}})},
          {"boxes side by side",
           Solid<2>(Union<2>{{Solid<2>(Box<2>{{-1, -1}, {0, 1}}), Solid<2>(Box<2>{{0, -1}, {1.5, 1}})}})},
          {"a plate with a hole",
           Solid<2>(Difference<2>{Solid<2>(Box<2>{{-1, -1}, {1, 1}}), {Solid<2>(Ball<2>{{0.2, 0.1}, 0.5})}})}};
}

Named<3> solids(std::integral_constant<int, 3>)
{
  const std::vector<ProfilePoint> profile{{0, 0}, {0.5, 0.4}, {1.2, 0.6}, {2, 0.55}};
  const Solid<3> rod(
      Union<3>{{Solid<3>(Ogive{{0, 0, -1}, {0, 0, 1}, 0.7}), Solid<3>(Cylinder{{0, 0, 1}, {0, 0, 2}, 0.7})}});
  return {{"box", Solid<3>(Box<3>{{-1, -0.5, 0}, {0.7, 1.5, 0.8}})},
          {"rotated box", Solid<3>(RotatedBox<3>{{0.2, 0.1, 0}, {2, 0.6, 1}, axis_rotation({1, 2, 3}, 0.7)})},
          {"ball", Solid<3>(Ball<3>{{0.3, -0.2, 0.1}, 1.1})},
          {"cylinder", Solid<3>(Cylinder{{-1, 0.2, 0}, {1, 0.5, 0.7}, 0.6})},
          {"pointed cone", Solid<3>(Cone{{-1, 0.2, 0}, {1, 0.5, 0.7}, 0, 0.8})},
          {"truncated cone", Solid<3>(Cone{{-1, 0.2, 0}, {1, 0.5, 0.7}, 0.9, 0.3})},
          {"ogive", Solid<3>(Ogive{{0, 0.3, -1}, {0.2, 0, 1}, 0.7})},
          {"half a ball", Solid<3>(Ogive{{0, 0, -1}, {0, 0, 0}, 1})},
          {"revolved", Solid<3>(Revolved({0, 0, -1}, {0, 0.2, 1}, profile))},
          {"revolved with a round tip", Solid<3>(Revolved({0, 0, -1}, {0, 0.2, 1}, profile, 0.1))},
          {"revolved with open ends", Solid<3>(Revolved({0, 0, -1}, {1, 0.2, 1}, {{0, 0.5}, {1, 0.2}, {1.5, 0.7}}))},
          {"prism", Solid<3>(ExtrudedPolygon{star(), -0.5, 0.8})},
          {"rod", rod},
          {"rod, moved", Solid<3>(Transformed<3>{rod, axis_rotation({0, 1, 1}, 2), {0.3, 0.2, -0.1}})},
          {"a block with a hole", Solid<3>(Difference<3>{Solid<3>(Box<3>{{-1, -1, -1}, {1, 1, 1}}),
                                                         {Solid<3>(Ball<3>{{0.2, 0.1, 0}, 0.5})}})}};
}

template <int D>
Vector<D> random_direction(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  return Vector<D>(Vector<D>::NullaryExpr([&] { return normal(random); })).normalized();
}

template <int D>
Vector<D> random_point(const Box<D>& box, std::mt19937& random)
{
  std::uniform_real_distribution<double> part(-0.3, 1.3);
  const Vector<D> sides = box.upper - box.lower;
  return box.lower + sides.cwiseProduct(Vector<D>(Vector<D>::NullaryExpr([&] { return part(random); })));
}

/// Whether inside and outside are both within 1e-7 m.
template <int D>
bool is_on_surface(const Solid<D>& solid, const Vector<D>& x, std::mt19937& random)
{
  bool holds = false, lacks = false;
  for (int i = 0; i < 4000 && !(holds && lacks); ++i) {
    (solid.contains(x + 1e-7 * random_direction<D>(random)) ? holds : lacks) = true;
  }
  return holds && lacks;
}

/// Whether a ball about x is wholly inside, or wholly outside.
template <int D>
bool is_clear(const Solid<D>& solid, const Vector<D>& x, double radius, std::mt19937& random)
{
  const bool is_inside = solid.contains(x);
  for (int i = 0; i < 400; ++i) {
    if (solid.contains(x + radius * random_direction<D>(random)) != is_inside) return false;
  }
  return true;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("no point of a surface is nearer than the nearest one", "", ((int D), D), 2, 3)
{
  std::mt19937 random(7);
  for (const auto& [name, solid] : solids(std::integral_constant<int, D>())) {
    const Box<D> box = solid.bounding_box();
    for (int i = 0; i < 200; ++i) {
      const Vector<D> x = random_point<D>(box, random);

      const SignedDistance<D> found = solid.distance(x);

      CAPTURE(name, i, x.transpose(), found.value, found.normal.transpose());
      REQUIRE((found.value < 0) == solid.contains(x));
      REQUIRE(std::abs(found.normal.norm() - 1) < 1e-14);
      REQUIRE(is_on_surface<D>(solid, x - found.value * found.normal, random));
      REQUIRE(is_clear<D>(solid, x, (1 - 1e-9) * std::abs(found.value), random));
    }
  }
}

TEST_CASE("a mesh is as far away as the nearest of its triangles")
{
  if (!ClosedMesh::is_available) return;
  // A tetrahedron with corners at the origin and at 1 on each axis.
  std::istringstream stl(
      "solid t\n"
      "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
      "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
      "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
      "endsolid t\n");
  const Solid<3> mesh(ClosedMesh(stl, 2));

  const SignedDistance<3> above = mesh.distance({1, 1, 1}), inside = mesh.distance({0.1, 0.5, 0.5}),
                          corner = mesh.distance({-3, -4, 0});

  CHECK(above.value == Approx(1 / std::sqrt(3.0)).epsilon(1e-12));
  CHECK(above.normal.isApprox(Vector<3>::Constant(1 / std::sqrt(3.0)), 1e-12));
  CHECK(inside.value == Approx(-0.1).epsilon(1e-12));
  CHECK(inside.normal.isApprox(-Vector<3>::Unit(0), 1e-12));
  CHECK(corner.value == Approx(5).epsilon(1e-12));
  CHECK(corner.normal.isApprox(Vector<3>(-0.6, -0.8, 0), 1e-12));
}

TEST_CASE("the distance has its sign where it is no more than a bound, too")
{
  const Solid<2> lens(Intersection<2>{{Solid<2>(Ball<2>{{-0.5, 0}, 1}), Solid<2>(Ball<2>{{0.5, 0}, 1})}}),
      tilted(Section{Solid<3>(RotatedBox<3>{{0, 0, 0}, {1, 2, 30}, axis_rotation({1, 0.3, 0}, 0.4)})});
  std::mt19937 random(7);
  for (const Solid<2>& solid : {lens, tilted}) {
    for (int i = 0; i < 2000; ++i) {
      const Vector<2> x = random_point<2>(solid.bounding_box(), random);

      CAPTURE(x.transpose(), solid.distance(x).value, solid.distance(x).normal.transpose());
      REQUIRE((solid.distance(x).value < 0) == solid.contains(x));
    }
  }
}

TEST_CASE("the normal on a face is the face's to round-off, however near the point is")
{
  const Solid<3> ball(Ball<3>{{0, 0, 0}, 2});
  for (const double off : {1e-3, 1e-8, 1e-14, 0.0, -1e-14, -1e-8}) {
    const SignedDistance<3> found = ball.distance({0, 2 + off, 0});

    CHECK(found.value == Approx(off).margin(1e-15));
    CHECK(found.normal.isApprox(Vector<3>::Unit(1), 1e-12));
  }
}

}  // namespace test_distance
