#pragma once

#include <algorithm>
#include <vector>

#include "components/geometry/fill.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// Where the particles of a solid of a material start.
template <int D>
std::vector<Vector<D>> sites_of(const Scene& scene, const components::Solid<D>& solid, int material)
{
  components::CellRange<D> cells{};
  std::copy_n(scene.grid.n_cells.begin(), D, cells.upper.begin());
  return components::fill(solid, lattice_of<D>(scene, material), cells);
}

template <int D>
std::vector<Vector<D>> sites_of(const Scene& scene, const SceneBody& body)
{
  return sites_of<D>(scene, std::get<components::Solid<D>>(body.solid), body.material);
}

}  // namespace tamp::tasks
