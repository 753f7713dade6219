#include "tasks/report/sample_walls.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "components/contact/wall_loads.hpp"
#include "tasks/labels.hpp"
#include "tasks/monitors.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

using components::PlaneWall;
using runtime::TaskContext;

namespace
{

/// The walls at which a patch ends.
std::vector<PlaneWall> walls_of(const std::vector<PlaneWall>& walls, const TaskContext& at)
{
  std::vector<PlaneWall> touched;
  std::copy_if(walls.begin(), walls.end(), std::back_inserter(touched), [&](const PlaneWall& wall) {
    const auto k = static_cast<std::size_t>(wall.axis);
    return wall.outside < 0 ? at.patch.cells.lower[k] == 0 : at.patch.cells.upper[k] == at.layout.grid().n_cells[k];
  });
  return touched;
}

/// Loads on the walls of a patch. The gaps at its nodes are those of its own particles, in place of all that reach
/// them: a sample needs no more, and a label for them would stay in memory.
template <int D>
std::vector<components::WallLoad> wall_loads(const Method<D>& method, const TaskContext& at,
                                             const components::LoadedParticles<D>& particles,
                                             const std::vector<PlaneWall>& walls)
{
  const runtime::IndexBox nodes = runtime::grown(at.patch.nodes, method.halo, D);
  std::vector<components::WallGaps<D>> gaps(static_cast<std::size_t>(nodes.size()));
  const auto block =
      block_of<D>(at.layout, runtime::GridView<components::WallGaps<D>>(gaps.data(), nodes, nodes.strides()));
  const auto& interpolation = method.interpolation(at.group);
  const double size = method.cell_size / method.scene.particles_per_axis_of(at.group);
  components::add_wall_gaps<D>(interpolation, block, particles.places, size, walls, gaps.data());
  std::vector<components::WallLoad> loads(particles.places.size());
  components::find_wall_loads<D>(interpolation, block, particles, walls, gaps.data(), loads);
  return loads;
}

}  // namespace

template <int D>
runtime::TaskList wall_sample_tasks(const Method<D>& method)
{
  if (method.image_walls.empty() || method.deformable_materials.empty()) return {};
  return {runtime::task("measure loads on walls")
              .over_patches_and_groups(method.deformable_materials)
              .sparse()
              .reads(particle::id.previous(), particle::position<D>.previous(),
                     particle::deformation_gradient<D>.previous(), particle::volume.previous(),
                     particle::stress<D>.previous())
              .reduces(wall_sample)
              .body([&method](const TaskContext& at, auto data) {
                const std::vector<PlaneWall> walls = walls_of(method.image_walls, at);
                if (walls.empty()) return;
                const auto id = data[particle::id.previous()];
                const auto position = data[particle::position<D>.previous()];
                const auto loads = wall_loads<D>(
                    method, at,
                    {places_at_start<D>(data), data[particle::volume.previous()], data[particle::stress<D>.previous()]},
                    walls);
                WallSample& sample = data[wall_sample];
                for (std::size_t p = 0; p < loads.size(); ++p) {
                  sample.early.whole += loads[p].whole;
                  sample.early.part += loads[p].early;
                  if (loads[p].early > 0) {
                    sample.first = std::min(sample.first, place_of<D>(id[p], at.group, position[p]));
                  }
                }
              })};
}

template runtime::TaskList wall_sample_tasks(const Method<2>&);
template runtime::TaskList wall_sample_tasks(const Method<3>&);

}  // namespace tamp::tasks
