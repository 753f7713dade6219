#include "tasks/report/sample_walls.hpp"

#include <algorithm>
#include <vector>

#include "components/contact/wall_loads.hpp"
#include "tasks/labels.hpp"
#include "tasks/monitors.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

namespace
{

template <int D>
runtime::TaskDeclaration measure_wall_loads(const Method<D>& method)
{
  return runtime::task("measure loads on walls")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(particle::id.previous(), particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
             particle::volume.previous(), particle::stress<D>.previous(), node::wall_gaps<D>.halo(method.halo))
      .reduces(wall_sample)
      .body([&method](const runtime::TaskContext& at, auto data) {
        const auto id = data[particle::id.previous()];
        const auto position = data[particle::position<D>.previous()];
        const auto gaps = data[node::wall_gaps<D>];
        std::vector<components::WallLoad> loads(id.size());
        components::find_wall_loads<D>(
            method.interpolation(at.group), block_of<D>(at.layout, gaps),
            {places_at_start<D>(data), data[particle::volume.previous()], data[particle::stress<D>.previous()]},
            method.image_walls, gaps.data(), loads);
        WallSample& sample = data[wall_sample];
        for (std::size_t p = 0; p < loads.size(); ++p) {
          sample.early.whole += loads[p].whole;
          sample.early.part += loads[p].early;
          if (loads[p].early > 0) sample.first = std::min(sample.first, place_of<D>(id[p], at.group, position[p]));
        }
      });
}

}  // namespace

template <int D>
runtime::TaskList wall_sample_tasks(const Method<D>& method)
{
  if (method.image_walls.empty() || method.deformable_materials.empty()) return {};
  runtime::TaskList tasks = find_wall_gaps(method, method.image_walls, method.deformable_materials);
  tasks.push_back(measure_wall_loads(method));
  return tasks;
}

template runtime::TaskList wall_sample_tasks(const Method<2>&);
template runtime::TaskList wall_sample_tasks(const Method<3>&);

}  // namespace tamp::tasks
