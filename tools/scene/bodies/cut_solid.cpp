#include "tools/scene/bodies/cut_solid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/geometry/set_operations.hpp"
#include "tasks/method.hpp"
#include "tools/scene/bodies/mirror_image.hpp"
#include "tools/scene/json/place_text.hpp"

namespace tamp::tools
{

namespace
{

constexpr char within_or_cut[] = "expected it to lie within the grid, or to be cut in halves by a \"symmetry\" face";

template <int D>
void add_problem_of_reach(const components::Box<D>& box, const JsonReader& reader)
{
  reader.add_problem("geometry", fmt::format("reaches from {} to {}", text<D>(box.lower), text<D>(box.upper)),
                     within_or_cut);
}

/// Faces beyond which a solid reaches. Lengths that are equal but for rounding are equal.
template <int D>
tasks::Sides faces_crossed(const components::Box<D>& box, const runtime::Grid& grid)
{
  const double slack = 1e-9 * grid.cell_size;
  tasks::Sides crossed{};
  for (int axis = 0; axis < D; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    crossed[k][0] = box.lower[axis] < grid.coordinate(axis, 0) - slack;
    crossed[k][1] = box.upper[axis] > grid.coordinate(axis, grid.n_cells[k]) + slack;
  }
  return crossed;
}

template <int D>
components::Box<D> box_within(const components::Box<D>& box, const tasks::Sides& cut, const runtime::Grid& grid)
{
  components::Box<D> within = box;
  for (int axis = 0; axis < D; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    if (cut[k][0]) within.lower[axis] = grid.coordinate(axis, 0);
    if (cut[k][1]) within.upper[axis] = grid.coordinate(axis, grid.n_cells[k]);
  }
  return within;
}

/// A box stays a box, whose volume is exact.
template <int D>
components::Solid<D> part_of(const components::Solid<D>& whole, const components::Box<D>& within)
{
  if (whole.template get_if<components::Box<D>>() != nullptr) return components::Solid<D>(within);
  return components::Solid<D>(components::Intersection<D>{{whole, components::Solid<D>(within)}});
}

/// Whether the whole is its own image in a face; if not, that is noted.
template <int D>
bool is_mirrored_at(const components::Solid<D>& whole, const tasks::Scene& scene, int material, std::size_t axis,
                    std::size_t side, const JsonReader& reader)
{
  const int k = static_cast<int>(axis);
  const double plane = scene.grid.coordinate(k, side == 0 ? 0 : scene.grid.n_cells[axis]);
  const auto place = first_without_image<D>(whole, tasks::lattice_of<D>(scene, material), k, plane);
  if (!place) return true;
  reader.add_problem(
      "geometry",
      fmt::format("reaches beyond {}{}, the plane {} = {} m, and is not symmetric about it: the image of "
                  "its place {} is not in it",
                  "xyz"[axis], "-+"[side], "xyz"[axis], plane, text<D>(*place)),
      within_or_cut);
  return false;
}

}  // namespace

template <int D>
std::optional<tasks::Sides> mirrors_crossed(const components::Solid<D>& solid, const tasks::Scene& scene,
                                            const JsonReader& reader)
{
  const components::Box<D> box = solid.bounding_box();
  const tasks::Sides crossed = faces_crossed<D>(box, scene.grid);
  for (std::size_t axis = 0; axis < D; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (!crossed[axis][side] || components::traits_of(scene.faces[axis][side]).is_mirror) continue;
      add_problem_of_reach<D>(box, reader);
      return std::nullopt;
    }
  }
  return crossed;
}

template <int D>
std::optional<components::Solid<D>> cut_at_mirrors(const components::Solid<D>& whole, const tasks::Sides& mirrors,
                                                   const tasks::Scene& scene, int material, const JsonReader& reader)
{
  if (mirrors == tasks::Sides{}) return whole;
  for (std::size_t axis = 0; axis < D; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (mirrors[axis][side] && !is_mirrored_at<D>(whole, scene, material, axis, side, reader)) return std::nullopt;
    }
  }
  const components::Box<D> box = whole.bounding_box(), within = box_within<D>(box, mirrors, scene.grid);
  if (!(within.lower.array() < within.upper.array()).all()) {
    add_problem_of_reach<D>(box, reader);
    return std::nullopt;
  }
  return part_of<D>(whole, within);
}

template std::optional<tasks::Sides> mirrors_crossed(const components::Solid<2>&, const tasks::Scene&,
                                                     const JsonReader&);
template std::optional<tasks::Sides> mirrors_crossed(const components::Solid<3>&, const tasks::Scene&,
                                                     const JsonReader&);
template std::optional<components::Solid<2>> cut_at_mirrors(const components::Solid<2>&, const tasks::Sides&,
                                                            const tasks::Scene&, int, const JsonReader&);
template std::optional<components::Solid<3>> cut_at_mirrors(const components::Solid<3>&, const tasks::Sides&,
                                                            const tasks::Scene&, int, const JsonReader&);

}  // namespace tamp::tools
