#include "components/geometry/closed_mesh.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/errors.hpp"
#include "components/geometry/checks.hpp"

namespace tamp::components
{

namespace
{

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangles = CGAL::Surface_mesh<Point>;
using Facet = std::array<std::size_t, 3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Triangles>>>;

constexpr const char* expected_surface = "a closed surface that does not cross itself";

Vector<3> vector(const Point& p)
{
  return {p.x(), p.y(), p.z()};
}

std::string middle(const Triangles& mesh, Triangles::Face_index face)
{
  Vector<3> sum = Vector<3>::Zero();
  for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) sum += vector(mesh.point(vertex));
  return text<3>(sum / 3);
}

/// Throws for a corner of a binary file that has no place: CGAL joins points that compare as equal, and with NaN any
/// do.
void require_places(std::istream& stl)
{
  constexpr std::size_t of_header = 80, of_facet = 50, of_normal = 3 * sizeof(float), of_corner = 3 * sizeof(float);
  const std::string bytes{std::istreambuf_iterator<char>(stl), {}};
  stl.clear();
  stl.seekg(0);
  std::uint32_t n_facets = 0;
  const std::size_t start = of_header + sizeof n_facets;
  if (bytes.size() < start) return;
  std::memcpy(&n_facets, bytes.data() + of_header, sizeof n_facets);
  if (n_facets > (bytes.size() - start) / of_facet) return;  // text, or cut off
  for (std::size_t i = 0; i < 3 * std::size_t{n_facets}; ++i) {
    std::array<float, 3> corner{};
    std::memcpy(corner.data(), bytes.data() + start + i / 3 * of_facet + of_normal + i % 3 * of_corner, of_corner);
    require_finite<3>({corner[0], corner[1], corner[2]}, "corner");
  }
}

/// Whether two corners of a triangle are equal: it then covers nothing, and CGAL does not accept it.
bool has_equal_corners(const Facet& facet)
{
  return facet[0] == facet[1] || facet[1] == facet[2] || facet[2] == facet[0];
}

/// The triangles of the file, joined where their points are equal.
Triangles read(std::istream& stl, double scale)
{
  require_places(stl);
  std::vector<Point> points;
  std::vector<Facet> facets;
  if (!CGAL::IO::read_STL(stl, points, facets) || facets.empty()) {
    throw BadValue("no STL, or one that is damaged", "triangles in STL, binary or text");
  }
  for (Point& p : points) {
    p = Point(scale * p.x(), scale * p.y(), scale * p.z());
    require_finite<3>(vector(p), "corner");
  }
  processing::merge_duplicate_points_in_polygon_soup(points, facets);
  std::erase_if(facets, has_equal_corners);
  processing::repair_polygon_soup(points, facets);
  processing::orient_polygon_soup(points, facets);
  if (facets.empty() || !processing::is_polygon_soup_a_polygon_mesh(facets)) {
    throw BadValue("triangles that do not make a surface", expected_surface);
  }
  Triangles mesh;
  processing::polygon_soup_to_polygon_mesh(points, facets, mesh);
  return mesh;
}

void require_closed(const Triangles& mesh)
{
  std::size_t n_open = 0;
  Triangles::Halfedge_index first;
  for (const auto edge : mesh.halfedges()) {
    if (!mesh.is_border(edge)) continue;
    if (n_open++ == 0) first = edge;
  }
  if (n_open == 0) return;
  throw BadValue("an open surface: " + std::to_string(n_open) + " edges have one triangle, such as that from " +
                     text<3>(vector(mesh.point(mesh.source(first)))) + " to " +
                     text<3>(vector(mesh.point(mesh.target(first)))),
                 expected_surface);
}

void require_no_crossing(const Triangles& mesh)
{
  std::vector<std::pair<Triangles::Face_index, Triangles::Face_index>> crossings;
  processing::self_intersections(mesh, std::back_inserter(crossings));
  if (crossings.empty()) return;
  const auto& [a, b] = *std::min_element(crossings.begin(), crossings.end());
  throw BadValue("a surface that crosses itself: " + std::to_string(crossings.size()) +
                     " pairs of triangles, such as those about " + middle(mesh, a) + " and " + middle(mesh, b),
                 expected_surface);
}

Vector<3> normal(const Triangles& mesh, Triangles::Face_index face)
{
  const auto edge = mesh.halfedge(face);
  const Vector<3> tip = vector(mesh.point(mesh.source(edge)));
  return (vector(mesh.point(mesh.target(edge))) - tip).cross(vector(mesh.point(mesh.target(mesh.next(edge)))) - tip);
}

/// A shell in another bounds a void if it faces into it. If both face the same way, a part that overlaps may be meant
/// as well. `oriented` is the mesh once its shells and voids all face away from what is filled.
void require_voids_to_face_in(Triangles& mesh, const Triangles& oriented)
{
  const auto volume = mesh.add_property_map<Triangles::Face_index, std::size_t>("f:volume", 0).first;
  const std::size_t n =
      processing::volume_connected_components(mesh, volume, CGAL::parameters::do_orientation_tests(false));
  std::vector<std::optional<bool>> turned(n);
  for (const auto face : mesh.faces()) {
    const bool is_turned = normal(mesh, face).dot(normal(oriented, face)) < 0;
    if (turned[volume[face]].value_or(is_turned) != is_turned) {
      throw BadValue("a shell within another that faces the same way, one of them about " + middle(mesh, face),
                     "a shell that bounds a void to face into it, and none in what is filled");
    }
    turned[volume[face]] = is_turned;
  }
}

}  // namespace

const bool ClosedMesh::is_available = true;

struct ClosedMesh::Surface {
  explicit Surface(Triangles triangles)
      : mesh(std::move(triangles)), tree(mesh.faces().begin(), mesh.faces().end(), mesh), side_of(tree)
  {
    tree.accelerate_distance_queries();
  }

  const Triangles mesh;
  /// Both refer to the mesh.
  Tree tree;
  const CGAL::Side_of_triangle_mesh<Triangles, Kernel> side_of;
};

ClosedMesh::ClosedMesh(std::istream& stl, double scale)
{
  Triangles mesh = read(stl, scale);
  require_closed(mesh);
  require_no_crossing(mesh);
  Triangles oriented = mesh;
  processing::orient_to_bound_a_volume(oriented);
  require_voids_to_face_in(mesh, oriented);
  surface_ = std::make_shared<const Surface>(std::move(oriented));
  require_positive(volume().value, "volume");
}

bool ClosedMesh::contains(const Vector<3>& x) const
{
  return surface_->side_of(Point(x[0], x[1], x[2])) == CGAL::ON_BOUNDED_SIDE;
}

double ClosedMesh::reach(const Vector<3>& direction) const
{
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Point& p : surface_->mesh.points()) furthest = std::max(furthest, vector(p).dot(direction));
  return furthest;
}

void ClosedMesh::faces(const Vector<3>& x, SurfacePoints<3>& points) const
{
  const auto [at, face] = surface_->tree.closest_point_and_primitive(Point(x[0], x[1], x[2]));
  points.push_back({vector(at), normal(surface_->mesh, face).normalized()});
}

Volume ClosedMesh::volume() const
{
  return {CGAL::to_double(processing::volume(surface_->mesh))};
}

}  // namespace tamp::components
