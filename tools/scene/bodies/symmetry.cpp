#include "tools/scene/bodies/symmetry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "tasks/method.hpp"
#include "tasks/rigid_body.hpp"
#include "tools/scene/bodies/mirror_image.hpp"

namespace tamp::tools
{

namespace
{

bool moves_across(const tasks::SceneBody& body, std::size_t axis)
{
  if (body.drive) return body.drive->motion.has_part_along(static_cast<int>(axis));
  return body.velocity[axis] != 0;
}

bool moves(const tasks::SceneBody& body)
{
  constexpr tasks::Triple zero{0, 0, 0};
  return body.rigid || body.velocity != zero || body.angular_velocity != zero;
}

bool turns_only_about(const tasks::SceneBody& body, std::size_t axis)
{
  return body.angular_velocity[(axis + 1) % 3] == 0 && body.angular_velocity[(axis + 2) % 3] == 0;
}

template <int D>
bool is_symmetric(const tasks::Scene& scene, const tasks::SceneBody& body, std::size_t axis, double plane)
{
  const auto& functions = body.functions;
  if (functions.velocity || functions.layout || functions.displacement || functions.body_force) return false;
  if (functions.deformation_gradient || functions.pressure) return false;
  if (moves_across(body, axis) || !turns_only_about(body, axis)) return false;
  const double slack = 1e-9 * scene.grid.cell_size;
  const auto is_off = [&](const tasks::Triple& end) { return std::abs(end[axis] - plane) > slack; };
  if (body.axis && (is_off(body.axis->nose) || is_off(body.axis->tail))) return false;
  const auto& solid = std::get<components::Solid<D>>(body.solid);
  const components::Box<D> box = solid.bounding_box();
  const int k = static_cast<int>(axis);
  if (std::abs(box.lower[k] + box.upper[k] - 2 * plane) > scene.grid.cell_size) return false;
  if (body.pressure && !is_mirrored(body.pressure->box, axis, plane, box.upper[k] - plane)) return false;
  return !first_without_image<D>(solid, tasks::lattice_of<D>(scene, body.material), k, plane);
}

/// Whether the scene is its own image in the plane halfway along an axis, along which the grid can be cut there.
template <int D>
bool is_symmetric(const tasks::Scene& scene, std::size_t axis)
{
  const auto& faces = scene.faces[axis];
  // A narrow grid is a column, whose sides are walls.
  constexpr int narrow = 4;
  const int n_cells = scene.grid.n_cells[axis];
  if (scene.grid.periodic[axis] || n_cells % 2 != 0 || n_cells < narrow) return false;
  if (faces[0] != faces[1] || !loads_are_mirrored(scene, axis)) return false;
  const double plane = scene.grid.coordinate(static_cast<int>(axis), scene.grid.n_cells[axis] / 2);
  return std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const tasks::SceneBody& body) { return is_symmetric<D>(scene, body, axis, plane); });
}

}  // namespace

bool loads_are_mirrored(const tasks::Scene& scene, std::size_t axis)
{
  if (scene.gravity[axis] != 0) return false;
  if (!scene.centrifuge) return true;
  const auto is_along = [&](const Eigen::Vector3d& v) {
    return std::abs(v[static_cast<int>(axis)]) >= (1 - 1e-12) * v.norm();
  };
  return is_along(scene.centrifuge->angular_velocity(0)) && is_along(scene.centrifuge->angular_velocity(1));
}

bool is_mirrored(const components::PressedBox<3>& pressed, std::size_t axis, double place, double reach)
{
  const int k = static_cast<int>(axis);
  const double before = std::min(place - pressed.lower[k], reach), beyond = std::min(pressed.upper[k] - place, reach);
  return std::abs(before - beyond) <= 1e-9 * reach;
}

bool is_one_cell_thick(const tasks::Scene& scene, int axis)
{
  const auto k = static_cast<std::size_t>(axis);
  return scene.grid.n_cells[k] == 1 && components::traits_of(scene.faces[k][0]).is_mirror &&
         components::traits_of(scene.faces[k][1]).is_mirror;
}

std::size_t first_axis_with_planes(const tasks::Scene& scene)
{
  return scene.axisymmetric ? 1 : 0;
}

tasks::Sides planes_of_symmetry(const tasks::Scene& scene)
{
  tasks::Sides planes{};
  for (const tasks::SceneBody& body : scene.bodies) {
    const tasks::Sides beneath = tasks::mirrors_beneath(scene, body);
    for (std::size_t axis = first_axis_with_planes(scene); axis < 3; ++axis) {
      const bool slides = moves(body) && !moves_across(body, axis) && loads_are_mirrored(scene, axis) &&
                          beneath[axis][0] != beneath[axis][1];
      for (std::size_t side = 0; side < 2; ++side) {
        planes[axis][side] |= body.cut[axis][side] || (slides && beneath[axis][side]);
      }
    }
  }
  return planes;
}

std::vector<std::size_t> symmetric_axes(const tasks::Scene& scene)
{
  std::vector<std::size_t> axes;
  const auto n_axes = static_cast<std::size_t>(scene.grid.dimension);
  axes.reserve(n_axes);
  for (std::size_t axis = first_axis_with_planes(scene); axis < n_axes; ++axis) {
    if (n_axes == 2 ? is_symmetric<2>(scene, axis) : is_symmetric<3>(scene, axis)) axes.push_back(axis);
  }
  return axes;
}

std::optional<std::string> advice_to_halve(const tasks::Scene& scene)
{
  const std::vector<std::size_t> axes = symmetric_axes(scene);
  if (axes.empty()) return std::nullopt;
  std::vector<double> lower(scene.grid.lower.begin(), scene.grid.lower.begin() + scene.grid.dimension);
  std::vector<int> patches(scene.n_patches.begin(), scene.n_patches.begin() + scene.grid.dimension);
  std::vector<std::string> planes(axes.size());
  double part = 1;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::size_t axis = axes[i];
    const int half = scene.grid.n_cells[axis] / 2;
    lower[axis] = scene.grid.coordinate(static_cast<int>(axis), half);
    if (patches[axis] > 1) patches[axis] = patches[axis] % 2 == 0 ? patches[axis] / 2 : 1;
    planes[i] = fmt::format("{} = {:.6g}", "xyz"[axis], lower[axis]);
    part /= 2;
  }
  constexpr std::array<const char*, 3> names{"half", "a quarter", "an eighth"};
  return fmt::format(
      "symmetric about {}: {} of the scene gives all of it for {:.3g} of the work of each step, with "
      "/grid/lower=[{:.6g}] "
      "/grid/patches=[{}]{}",
      fmt::join(planes, " and "), names[axes.size() - 1], part, fmt::join(lower, ","), fmt::join(patches, ","),
      std::all_of(axes.begin(), axes.end(),
                  [&](std::size_t axis) { return components::traits_of(scene.faces[axis][0]).is_mirror; })
          ? ""
          : " and \"symmetry\" at the lower face");
}

}  // namespace tamp::tools
