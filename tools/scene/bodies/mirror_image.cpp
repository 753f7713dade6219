#include "tools/scene/bodies/mirror_image.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp::tools
{

namespace
{

/// All cells that a solid may have a part of, of a lattice without ends.
template <int D>
components::CellRange<D> cells_around(const components::Solid<D>& solid, const components::ParticleLattice<D>& lattice)
{
  // No body of a scene lies further away than that [cells].
  constexpr double most = 1e8;
  const components::Box<D> box = solid.bounding_box();
  const auto cell = [&](double x, int axis) {
    return static_cast<int>(std::clamp(std::floor((x - lattice.origin[axis]) / lattice.cell_size), -most, most));
  };
  components::CellRange<D> cells;
  for (int axis = 0; axis < D; ++axis) {
    cells.lower[static_cast<std::size_t>(axis)] = cell(box.lower[axis], axis) - 1;
    cells.upper[static_cast<std::size_t>(axis)] = cell(box.upper[axis], axis) + 2;
  }
  return cells;
}

/// A box that is its own image but for rounding: such as ground that is far larger than the grid, whose sites are many.
template <int D>
bool is_mirrored_box(const components::Solid<D>& solid, int axis, double place)
{
  const auto* box = solid.template get_if<components::Box<D>>();
  if (box == nullptr) return false;
  const double before = place - box->lower[axis], beyond = box->upper[axis] - place;
  return std::abs(before - beyond) <= 1e-9 * (before + beyond);
}

}  // namespace

template <int D>
std::optional<Vector<D>> first_without_image(const components::Solid<D>& solid,
                                             const components::ParticleLattice<D>& lattice, int axis, double place)
{
  if (is_mirrored_box<D>(solid, axis, place)) return std::nullopt;
  constexpr double on_surface = 1e-3;
  std::optional<Vector<D>> first;
  double n_without = 0;
  const auto sites = components::fill(solid, lattice, cells_around<D>(solid, lattice));
  for (const Vector<D>& site : sites) {
    Vector<D> image = site;
    image[axis] = 2 * place - site[axis];
    if (solid.contains(image)) continue;
    if (!first) first = site;
    ++n_without;
  }
  if (n_without <= on_surface * static_cast<double>(sites.size())) return std::nullopt;
  return first;
}

template std::optional<Vector<2>> first_without_image(const components::Solid<2>&,
                                                      const components::ParticleLattice<2>&, int, double);
template std::optional<Vector<3>> first_without_image(const components::Solid<3>&,
                                                      const components::ParticleLattice<3>&, int, double);

}  // namespace tamp::tools
