#include <algorithm>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// Axes along which particles of a patch can leave the grid: a step takes them no further than to a neighbour.
std::vector<std::size_t> open_axes(const runtime::Grid& grid, const runtime::Patch& patch)
{
  std::vector<std::size_t> axes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
    const bool at_end = patch.cells.lower[k] == 0 || patch.cells.upper[k] == grid.n_cells[k];
    if (at_end && !grid.periodic[k]) axes.push_back(k);
  }
  return axes;
}

}  // namespace

template <int D>
runtime::TaskList count_lost(const Method<D>&)
{
  return {runtime::task("count lost particles")
              .over_patches_and_groups()
              .sparse()
              .reads(particle::mass.previous(), particle::position<D>, particle::velocity<D>)
              .reduces(lost_particles)
              .body([](const TaskContext& at, auto data) {
                const auto mass = data[particle::mass.previous()];
                const auto position = data[particle::position<D>];
                const auto velocity = data[particle::velocity<D>];
                LostParticles& lost = data[lost_particles];
                const runtime::Grid& grid = at.layout.grid();
                const std::vector<std::size_t> axes = open_axes(grid, at.patch);
                const auto stays = [&](const Vector<D>& x) {
                  return std::all_of(axes.begin(), axes.end(),
                                     [&](std::size_t k) { return grid.spans(k, x[static_cast<int>(k)]); });
                };
                for (std::size_t p = 0; p < mass.size(); ++p) {
                  if (stays(position[p])) continue;
                  ++lost.count;
                  lost.mass += mass[p];
                  lost.kinetic += 0.5 * mass[p] * velocity[p].squaredNorm();
                  lost.momentum.template head<D>() += mass[p] * velocity[p];
                }
              })};
}

template runtime::TaskList count_lost(const Method<2>&);
template runtime::TaskList count_lost(const Method<3>&);

}  // namespace tamp::tasks
