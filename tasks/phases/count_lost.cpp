#include <array>
#include <cstddef>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// Along which axes particles of a patch can leave the grid: a step takes them no further than to a neighbour.
template <int D>
std::array<bool, D> open_axes(const runtime::Grid& grid, const runtime::Patch& patch)
{
  std::array<bool, D> open;
  for (std::size_t k = 0; k < D; ++k) {
    const bool at_end = patch.cells.lower[k] == 0 || patch.cells.upper[k] == grid.n_cells[k];
    open[k] = at_end && !grid.periodic[k];
  }
  return open;
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
                const std::array<bool, D> open = open_axes<D>(grid, at.patch);
                const auto stays = [&](const Vector<D>& x) {
                  bool is_inside = true;
                  for (std::size_t k = 0; k < D; ++k) is_inside &= !open[k] || grid.spans(k, x[static_cast<int>(k)]);
                  return is_inside;
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
