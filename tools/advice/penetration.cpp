#include "tools/advice/penetration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "tasks/set_up/initial_moduli.hpp"

namespace tamp::tools
{

namespace
{

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Rounding error of numbers of cells, and of directions along an axis.
constexpr double rounding = 1e-9;

/// Place of the wall at which the grid ends in a direction, x . direction [m]; infinite where the grid is open there,
/// or the direction is not along an axis.
double wall_in(const tasks::Scene& scene, const Vector3d& direction)
{
  for (int axis = 0; axis < scene.grid.dimension; ++axis) {
    if (std::abs(direction[axis]) < 1 - rounding) continue;
    const auto a = static_cast<std::size_t>(axis);
    const bool is_upper = direction[axis] > 0;
    if (components::traits_of(scene.faces[a][is_upper]).beyond == components::Beyond::away) return infinity;
    return direction[axis] * scene.grid.coordinate(axis, is_upper ? scene.grid.n_cells[a] : 0);
  }
  return infinity;
}

bool lies_on_wall(const tasks::Scene& scene, const tasks::SceneBody& body, const Vector3d& direction)
{
  const double spacing = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
  return reach(body, direction) > wall_in(scene, direction) - 0.5 * spacing;
}

/// The directions across the way: one in the plane, two in space, along the grid's axes where the way is.
std::vector<Vector3d> directions_across(const tasks::Scene& scene, const Vector3d& way)
{
  if (scene.grid.dimension == 2) return {Vector3d(-way.y(), way.x(), 0)};
  Eigen::Index axis = 0;
  way.cwiseAbs().minCoeff(&axis);
  const Vector3d one = way.cross(Vector3d::Unit(axis)).normalized();
  return {one, way.cross(one)};
}

double half_width(const tasks::Scene& scene, const tasks::SceneBody& body, const Vector3d& across)
{
  const int n_walls = lies_on_wall(scene, body, across) + lies_on_wall(scene, body, -across);
  const double width = reach(body, across) + reach(body, -across);
  if (n_walls == 2) return infinity;
  return n_walls == 1 ? width : width / 2;
}

/// Width along `across` over which two bodies cover each other [m].
double overlap(const tasks::SceneBody& a, const tasks::SceneBody& b, const Vector3d& across)
{
  return std::min(reach(a, across), reach(b, across)) + std::min(reach(a, -across), reach(b, -across));
}

/// Whether a body runs into another one by their bounding boxes: where they cover each other by less than half a cell,
/// it slides along.
bool runs_into(const tasks::Scene& scene, const tasks::SceneBody& body, const tasks::SceneBody& other,
               const Vector3d& way)
{
  const Vector3d ahead = way.normalized();
  const double front = reach(body, ahead), near_end = -reach(other, -ahead), far_end = reach(other, ahead);
  if (front >= far_end || front + way.norm() <= near_end) return false;
  const std::vector<Vector3d> across = directions_across(scene, ahead);
  return std::all_of(across.begin(), across.end(), [&](const Vector3d& direction) {
    return overlap(body, other, direction) > 0.5 * scene.grid.cell_size;
  });
}

/// Stiffness of the unstrained material for waves [Pa].
double stiffness_of(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  if (body.rigid) return infinity;
  const auto [K, G] = tasks::initial_moduli(scene.materials[static_cast<std::size_t>(body.material)]);
  return K + 4 * G / 3;
}

/// The half width with which a body runs into another one [m]; infinite where it does not.
double half_width_into(const tasks::Scene& scene, const tasks::SceneBody& body, const tasks::SceneBody& other)
{
  const Vector3d way = way_of(scene, body) - way_of(scene, other);
  const bool can_enter =
      body.material != other.material && stiffness_of(scene, body) > stiffness_of(scene, other) && way.norm() > 0;
  if (!can_enter || !runs_into(scene, body, other, way)) return infinity;
  double least = infinity;
  for (const Vector3d& across : directions_across(scene, way.normalized())) {
    least = std::min(least, half_width(scene, body, across));
  }
  return least;
}

/// Rounds down to two digits; a number that is below one of two digits by a rounding error becomes that one.
double rounded_down(double x)
{
  const double digit = std::pow(10, std::floor(std::log10(x)) - 1);
  return std::floor(x / digit * (1 + rounding)) * digit;
}

}  // namespace

double reach(const tasks::SceneBody& body, const Vector3d& direction)
{
  if (const auto* plane = std::get_if<components::Solid<2>>(&body.solid)) return plane->reach(direction.head<2>());
  return std::get<components::Solid<3>>(body.solid).reach(direction);
}

Vector3d way_of(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  if (body.drive) return body.drive->motion.way(0, scene.time.end);
  return scene.time.end * Vector3d(body.velocity.data());
}

double waves_in(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  return tasks::initial_wave_speed(scene.materials[static_cast<std::size_t>(body.material)]);
}

bool Penetration::is_coarse() const
{
  return cells() < least_cells_per_half_width * (1 - rounding);
}

double Penetration::fine_cell_size() const
{
  return rounded_down(half_width / least_cells_per_half_width);
}

bool meets_no_other(const tasks::Scene& scene, const tasks::SceneBody& body, const Vector3d& way)
{
  return std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const tasks::SceneBody& other) {
    return &other != &body && runs_into(scene, body, other, way);
  });
}

std::optional<Penetration> penetration_of(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  Penetration thinnest{nullptr, infinity, scene.grid.cell_size};
  for (const tasks::SceneBody& other : scene.bodies) {
    const double half = half_width_into(scene, body, other);
    if (half >= thinnest.half_width) continue;
    thinnest.into = &other;
    thinnest.half_width = half;
  }
  if (thinnest.into == nullptr) return std::nullopt;
  return thinnest;
}

}  // namespace tamp::tools
