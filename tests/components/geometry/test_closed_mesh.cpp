#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <vector>

#include "components/errors.hpp"
#include "components/geometry/closed_mesh.hpp"
#include "components/geometry/solid.hpp"

namespace test_closed_mesh
{

using namespace tamp;
using namespace tamp::components;

namespace
{

using Triangle = std::array<Vector<3>, 3>;

/// The twelve triangles of a cube of edge 1, their sense outward.
std::vector<Triangle> cube(const Vector<3>& lower)
{
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector<3> u = Vector<3>::Unit((axis + 1) % 3), v = Vector<3>::Unit((axis + 2) % 3);
    const Vector<3> upper = lower + Vector<3>::Unit(axis);
    triangles.push_back({lower, lower + v, lower + u});
    triangles.push_back({lower + u, lower + v, lower + u + v});
    triangles.push_back({upper, upper + u, upper + v});
    triangles.push_back({upper + u, upper + u + v, upper + v});
  }
  return triangles;
}

std::string stl(const std::vector<Triangle>& triangles)
{
  std::ostringstream out;
  out << "solid test\n";
  for (const Triangle& triangle : triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const Vector<3>& p : triangle) out << "vertex " << p.transpose() << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid test\n";
  return out.str();
}

std::string binary_stl(const std::vector<Triangle>& triangles)
{
  std::string bytes(80, ' ');
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    add(std::array<float, 3>{});
    for (const Vector<3>& p : triangle) add(Eigen::Vector3f(p.cast<float>()));
    add(std::uint16_t{0});
  }
  return bytes;
}

Solid<3> mesh(const std::string& text, double scale = 1)
{
  std::istringstream stream(text);
  return Solid<3>(ClosedMesh(stream, scale));
}

std::vector<Triangle> joined(std::vector<Triangle> a, const std::vector<Triangle>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The fault found in a mesh.
std::string fault(const std::string& text)
{
  try {
    mesh(text);
    return "";
  } catch (const BadValue& bad) {
    return bad.found;
  }
}

}  // namespace

TEST_CASE("a mesh of a cube holds what the cube holds, scaled")
{
  if (!ClosedMesh::is_available) return;
  const Solid<3> solid = mesh(stl(cube({1, 2, 3})), 0.1);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> coordinate(0, 0.5);
  bool agree = true;

  for (int i = 0; i < 20000; ++i) {
    const Vector<3> x(coordinate(engine), coordinate(engine), coordinate(engine));
    const bool inside = x[0] > 0.1 && x[0] < 0.2 && x[1] > 0.2 && x[1] < 0.3 && x[2] > 0.3 && x[2] < 0.4;
    agree = agree && solid.contains(x) == inside;
  }

  CHECK(agree);
  CHECK(solid.volume().value == Approx(1e-3));
  CHECK(solid.bounding_box().lower.isApprox(Vector<3>(0.1, 0.2, 0.3)));
}

TEST_CASE("the sense of a mesh's triangles does not matter")
{
  if (!ClosedMesh::is_available) return;
  std::vector<Triangle> triangles = cube({0, 0, 0});
  for (std::size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i][0], triangles[i][1]);

  const Solid<3> solid = mesh(stl(triangles));

  CHECK(solid.volume().value == Approx(1));
  CHECK(solid.contains({0.5, 0.5, 0.5}));
}

TEST_CASE("a mesh of two parts holds both")
{
  if (!ClosedMesh::is_available) return;
  const Solid<3> solid = mesh(stl(joined(cube({0, 0, 0}), cube({2, 0, 0}))));

  CHECK(solid.volume().value == Approx(2));
  CHECK(solid.contains({2.5, 0.5, 0.5}));
  CHECK_FALSE(solid.contains({1.5, 0.5, 0.5}));
}

TEST_CASE("a mesh within another is a void where it faces into it, and refused where both face the same way")
{
  if (!ClosedMesh::is_available) return;
  std::vector<Triangle> small = cube({1, 1, 1}), large = cube({0, 0, 0});
  for (Triangle& triangle : large) {
    for (Vector<3>& p : triangle) p *= 3;
  }
  std::vector<Triangle> inward = small, large_inward = large;
  for (Triangle& triangle : inward) std::swap(triangle[0], triangle[1]);
  for (Triangle& triangle : large_inward) std::swap(triangle[0], triangle[1]);

  for (const auto& hollow : {joined(large, inward), joined(large_inward, small)}) {
    const Solid<3> solid = mesh(stl(hollow));
    CHECK(solid.volume().value == Approx(26));
    CHECK_FALSE(solid.contains({1.5, 1.5, 1.5}));
    CHECK(solid.contains({0.5, 1.5, 1.5}));
  }
  for (const auto& doubtful : {joined(large, small), joined(large_inward, inward), joined(small, large)}) {
    CHECK_THAT(fault(stl(doubtful)), Catch::StartsWith("a shell within another that faces the same way, one of them "));
  }
  CHECK(fault(stl(joined(joined(large, inward), cube({5, 0, 0})))).empty());
}

TEST_CASE("an open mesh is refused with its first open edge")
{
  if (!ClosedMesh::is_available) return;
  std::vector<Triangle> triangles = cube({0, 0, 0});
  triangles.pop_back();

  CHECK_THAT(fault(stl(triangles)),
             Catch::StartsWith("an open surface: 3 edges have one triangle, such as that from ["));
}

TEST_CASE("a mesh that crosses itself is refused with where")
{
  if (!ClosedMesh::is_available) return;
  const std::string found = fault(stl(joined(cube({0, 0, 0}), cube({0.5, 0.4, 0.3}))));

  CHECK_THAT(found, Catch::StartsWith("a surface that crosses itself: ") && Catch::Contains("such as those about ["));
}

TEST_CASE("text that is no STL, or is cut short, is refused")
{
  if (!ClosedMesh::is_available) return;
  const std::string whole = stl(cube({0, 0, 0}));

  CHECK(!fault("").empty());
  CHECK(!fault("nothing of the kind").empty());
  CHECK(!fault("solid empty\nendsolid empty\n").empty());
  CHECK(!fault(whole.substr(0, whole.size() / 2)).empty());
  CHECK(fault(whole).empty());
}

TEST_CASE("a corner of a binary mesh that is NaN or infinite is refused, though all but that is another corner's")
{
  if (!ClosedMesh::is_available) return;
  std::vector<Triangle> triangles = cube({0, 0, 0});
  CHECK(fault(binary_stl(triangles)).empty());

  for (const double odd : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    triangles.back()[2].x() = odd;
    CHECK_THAT(fault(binary_stl(triangles)), Catch::StartsWith("corner ["));
  }
}

TEST_CASE("a triangle of a mesh with two equal corners is no part of its surface")
{
  if (!ClosedMesh::is_available) return;
  std::vector<Triangle> triangles = cube({0, 0, 0});

  triangles.push_back({triangles[0][0], triangles[0][1], triangles[0][1]});

  CHECK(fault(stl(triangles)).empty());
  CHECK(mesh(stl(triangles)).volume().value == Approx(1));
  CHECK(fault(stl({triangles.back()})) == "triangles that do not make a surface");
}

}  // namespace test_closed_mesh
