#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "components/geometry/fill.hpp"
#include "tasks/method.hpp"

namespace tamp::tools
{

/// Where the particles of a solid of this material start.
template <int D>
std::vector<Vector<D>> sites(const components::Solid<D>& solid, const tasks::Scene& scene, int material)
{
  components::CellRange<D> cells{};
  std::copy_n(scene.grid.n_cells.begin(), D, cells.upper.begin());
  return components::fill(solid, tasks::lattice_of<D>(scene, material), cells);
}

template <int D>
std::vector<Vector<D>> sites(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  return sites<D>(std::get<components::Solid<D>>(body.solid), scene, body.material);
}

/// A place as problems name it.
template <int D>
std::string text(const Vector<D>& v)
{
  return fmt::format("[{}]", fmt::join(v.data(), v.data() + D, ", "));
}

}  // namespace tamp::tools
