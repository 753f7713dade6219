#include "tools/advice/round_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tasks/method.hpp"

namespace tamp::tools
{

namespace
{

using Region = components::Solid<3>;

/// A line along an axis of the grid, and the two axes across it.
struct Line {
  int axis;
  Vector<3> through;

  int first_across() const { return (axis + 1) % 3; }
  int second_across() const { return (axis + 2) % 3; }

  /// The point at a height along the line, a distance from it and an angle about it.
  Vector<3> at(double height, double radius, double angle) const
  {
    Vector<3> x = through;
    x[axis] = height;
    x[first_across()] += radius * std::cos(angle);
    x[second_across()] += radius * std::sin(angle);
    return x;
  }
};

components::Box<3> box_of(const runtime::Grid& grid)
{
  components::Box<3> box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = grid.coordinate(k, 0);
    box.upper[k] = grid.coordinate(k, grid.n_cells[static_cast<std::size_t>(k)]);
  }
  return box;
}

bool is_within(const components::Box<3>& box, const Vector<3>& x)
{
  return (x - box.lower).minCoeff() >= 0 && (box.upper - x).minCoeff() >= 0;
}

/// Numbers of [0, 1) in up to five dimensions that fill them evenly: the additive recurrence by the powers of the root
/// of t^6 = t + 1.
double spread(int i, int dimension)
{
  constexpr std::array<double, 5> strides{0.8812714616335696, 0.7766393890897682, 0.6844301295853426,
                                          0.6031687406857282, 0.5315553977157913};
  const double place = 0.5 + i * strides[static_cast<std::size_t>(dimension)];
  return place - std::floor(place);
}

/// Cost of a particle in the plane over that of one in space (docs/reference/advice.md).
constexpr double plane_particle_cost = 0.5;

constexpr int n_samples = 16'000;
/// Share of the points that may differ, as surfaces have facets or are cut by rounding.
constexpr double most_off = 0.01;

/// Whether the solid goes on across the line as far as the grid does.
bool fills_across(const Region& solid, const Line& line, const components::Box<3>& grid)
{
  const components::Box<3> box = solid.bounding_box();
  const Vector<3> edges = grid.upper - grid.lower;
  const int a = line.first_across(), b = line.second_across();
  int n_off = 0;
  for (int i = 0; i < n_samples; ++i) {
    Vector<3> x, y;
    x[a] = grid.lower[a] + spread(i, 0) * edges[a];
    x[b] = grid.lower[b] + spread(i, 1) * edges[b];
    y[a] = grid.lower[a] + spread(i, 2) * edges[a];
    y[b] = grid.lower[b] + spread(i, 3) * edges[b];
    x[line.axis] = y[line.axis] = box.lower[line.axis] + spread(i, 4) * (box.upper[line.axis] - box.lower[line.axis]);
    if (solid.contains(x) != solid.contains(y)) ++n_off;
  }
  return n_off < most_off * n_samples;
}

/// How far a box reaches from the line along an axis across it.
double reach_of(const components::Box<3>& box, const Line& line, int k)
{
  return std::max(std::abs(box.lower[k] - line.through[k]), std::abs(box.upper[k] - line.through[k]));
}

/// Whether the solid is the same at all angles about the line that lie within the grid, which holds a quarter of it.
bool is_round(const Region& solid, const Line& line, const components::Box<3>& grid)
{
  const components::Box<3> box = solid.bounding_box();
  const double reach = reach_of(box, line, line.first_across());
  if (std::abs(reach - reach_of(box, line, line.second_across())) > most_off * reach) return false;
  const double to_corner = std::numbers::sqrt2 * reach;
  int n_seen = 0, n_off = 0;
  for (int i = 0; i < n_samples; ++i) {
    const double height = box.lower[line.axis] + spread(i, 0) * (box.upper[line.axis] - box.lower[line.axis]);
    const double radius = spread(i, 1) * to_corner;
    const Vector<3> x = line.at(height, radius, 2 * std::numbers::pi * spread(i, 2));
    const Vector<3> y = line.at(height, radius, 2 * std::numbers::pi * spread(i, 3));
    if (!is_within(grid, x) || !is_within(grid, y)) continue;
    const bool x_is_in = solid.contains(x), y_is_in = solid.contains(y);
    n_seen += x_is_in || y_is_in ? 1 : 0;
    n_off += x_is_in != y_is_in ? 1 : 0;
  }
  return n_seen > 0 && n_off < most_off * n_seen;
}

/// Whether all that moves the body goes along the axis.
bool moves_along(const tasks::SceneBody& body, int axis)
{
  if (body.functions.velocity || body.functions.body_force || body.is_pressed()) return false;
  if (body.angular_velocity != tasks::Triple{0, 0, 0} || (body.drive && body.drive->turns)) return false;
  for (int k = 0; k < 3; ++k) {
    if (k == axis) continue;
    if (body.velocity[static_cast<std::size_t>(k)] != 0) return false;
    if (body.drive && body.drive->motion.has_part_along(k)) return false;
  }
  return true;
}

/// Whether the scene treats all directions across the axis alike, but for its bodies.
bool is_even_across(const tasks::Scene& scene, int axis)
{
  if (scene.centrifuge) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (static_cast<int>(k) == axis) continue;
    if (scene.gravity[k] != 0 || scene.grid.periodic[k]) return false;
  }
  return std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [axis](const tasks::SceneBody& body) { return moves_along(body, axis); });
}

/// Where the line may lie along an axis across it: on symmetry faces, or in the middle.
std::vector<double> places_across(const tasks::Scene& scene, int axis, const components::Box<3>& grid)
{
  const auto& faces = scene.faces[static_cast<std::size_t>(axis)];
  std::vector<double> places;
  places.reserve(3);
  if (components::traits_of(faces[0]).is_mirror) places.push_back(grid.lower[axis]);
  if (components::traits_of(faces[1]).is_mirror) places.push_back(grid.upper[axis]);
  places.push_back(0.5 * (grid.lower[axis] + grid.upper[axis]));
  return places;
}

/// Sites of a body's lattice in the half plane that is turned about the line, out to the farther face.
std::size_t n_rings(const tasks::Scene& scene, const tasks::SceneBody& body, const Line& line,
                    const components::Box<3>& grid)
{
  const auto& solid = std::get<Region>(body.solid);
  const components::Box<3> box = solid.bounding_box();
  const double spacing = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
  const int k = line.first_across();
  const double above = grid.upper[k] - line.through[k], below = line.through[k] - grid.lower[k];
  const double reach = std::max(above, below), angle = above >= below ? 0 : std::numbers::pi;
  std::size_t n = 0;
  for (double z = box.lower[line.axis] + 0.5 * spacing; z < box.upper[line.axis]; z += spacing) {
    for (double r = 0.5 * spacing; r < reach; r += spacing) {
      if (solid.contains(line.at(z, r, angle))) ++n;
    }
  }
  return n;
}

/// The axisymmetric scene about a line, if all bodies are round about it and not all only fill the grid.
std::optional<RoundScene> about(const tasks::Scene& scene, const Line& line, const components::Box<3>& grid)
{
  RoundScene found{line.axis, line.through, 0};
  bool any_round = false;
  for (const tasks::SceneBody& body : scene.bodies) {
    const auto& solid = std::get<Region>(body.solid);
    if (!fills_across(solid, line, grid)) {
      if (!is_round(solid, line, grid)) return std::nullopt;
      any_round = true;
    }
    found.n_particles += n_rings(scene, body, line, grid);
  }
  return any_round ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<RoundScene> round_scene(const tasks::Scene& scene)
{
  if (scene.grid.dimension != 3) return std::nullopt;
  const components::Box<3> grid = box_of(scene.grid);
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_even_across(scene, axis)) continue;
    Line line{axis, Vector<3>::Zero()};
    for (const double a : places_across(scene, line.first_across(), grid)) {
      for (const double b : places_across(scene, line.second_across(), grid)) {
        line.through[line.first_across()] = a;
        line.through[line.second_across()] = b;
        if (const auto found = about(scene, line, grid)) return found;
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> advice_to_turn(const tasks::Scene& scene)
{
  const auto found = round_scene(scene);
  if (!found) return std::nullopt;
  std::string across;
  for (int k = 0; k < 3; ++k) {
    if (k != found->axis)
      across += fmt::format("{}{} = {:.6g}", across.empty() ? "" : ", ", "xyz"[k], found -> through[k]);
  }
  const double part = static_cast<double>(found->n_particles) / static_cast<double>(scene.n_particles());
  return fmt::format(
      "round about the line {}: axisymmetric, it would have {} particles in place of {}, and take about {:.2g} of the "
      "work "
      "of each step",
      across, found->n_particles, scene.n_particles(), part * plane_particle_cost);
}

}  // namespace tamp::tools
