#include "components/contact/wall_gaps.hpp"

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/scatter.hpp"

namespace tamp::tasks
{

template <int D>
runtime::TaskList find_wall_gaps(const Method<D>& method)
{
  if (method.edge_walls.empty()) return {};
  return {runtime::task("find gaps to walls")
              .over_patches_and_groups()
              .sparse()
              .reads(particle::position<D>.previous(), particle::deformation_gradient<D>.previous())
              .accumulates(node::wall_gaps<D>.halo(method.halo))
              .body([&method](const runtime::TaskContext& at, auto data) {
                if (method.rigid_body(at.group) != nullptr) return;
                const auto gaps = data[node::wall_gaps<D>];
                const double size = method.cell_size / method.scene.particles_per_axis_of(at.group);
                components::add_wall_gaps<D>(method.interpolation(at.group), block_of<D>(at.layout, gaps),
                                             places_at_start<D>(data), size, method.edge_walls, gaps.data());
                fold_images(method, at, gaps, true);
              })};
}

template runtime::TaskList find_wall_gaps(const Method<2>&);
template runtime::TaskList find_wall_gaps(const Method<3>&);

}  // namespace tamp::tasks
