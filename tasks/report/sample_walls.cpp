#include "tasks/report/sample_walls.hpp"

#include <algorithm>

#include "components/contact/wall_loads.hpp"
#include "tasks/labels.hpp"
#include "tasks/monitors.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

bool ends_at(const runtime::Patch& patch, const runtime::Grid& grid, const components::PlaneWall& wall)
{
  const auto k = static_cast<std::size_t>(wall.axis);
  return wall.outside < 0 ? patch.cells.lower[k] == 0 : patch.cells.upper[k] == grid.n_cells[k];
}

/// The gaps at the nodes of a patch are those of its own particles, in place of all that reach them: enough for a
/// sample, and no halo has to be summed.
template <int D>
runtime::TaskDeclaration measure_wall_loads(const Method<D>& method)
{
  return runtime::task("measure loads on walls")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(particle::id.previous(), particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
             particle::volume.previous(), particle::stress<D>.previous())
      .computes(node::wall_gaps<D>.halo(method.halo))
      .reduces(wall_sample)
      .body([&method](const TaskContext& at, auto data) {
        const auto gaps = data[node::wall_gaps<D>];
        for_each(gaps.box(), [&](const runtime::Index& i) { gaps[i] = {}; });
        const auto is_elsewhere = [&](const auto& wall) { return !ends_at(at.patch, at.layout.grid(), wall); };
        if (std::ranges::all_of(method.image_walls, is_elsewhere)) return;
        const auto& interpolation = method.interpolation(at.group);
        const auto block = block_of<D>(at.layout, gaps);
        const auto places = places_at_start<D>(data);
        const double size = method.cell_size / method.scene.particles_per_axis_of(at.group);
        components::add_wall_gaps<D>(interpolation, block, places, size, method.image_walls, gaps.data());
        const auto id = data[particle::id.previous()];
        const auto [early, whole, first] = components::wall_loads<D>(
            interpolation, block, {id, places, data[particle::volume.previous()], data[particle::stress<D>.previous()]},
            method.image_walls, gaps.data());
        WallSample& sample = data[wall_sample];
        sample.early.part += early;
        sample.early.whole += whole;
        if (first < 0) return;
        const auto p = static_cast<std::size_t>(first);
        sample.first = std::min(sample.first, place_of<D>(id[p], at.group, places.position[p]));
      });
}

}  // namespace

template <int D>
runtime::TaskList wall_sample_tasks(const Method<D>& method)
{
  if (method.image_walls.empty() || method.deformable_materials.empty()) return {};
  return {measure_wall_loads(method)};
}

template runtime::TaskList wall_sample_tasks(const Method<2>&);
template runtime::TaskList wall_sample_tasks(const Method<3>&);

}  // namespace tamp::tasks
