#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases.hpp"
#include "tasks/walls.hpp"

namespace tamp::tasks
{

using components::SymmetryWall;
using runtime::TaskContext;

template <class Interpolator>
runtime::TaskDeclaration particles_to_grid(const Method<Interpolator>& method)
{
  constexpr int D = Interpolator::dimension;
  auto task =
      runtime::task("particles to grid")
          .over_patches_and_groups()
          .sparse()
          .reads(particle::position<D>.previous(), particle::velocity<D>.previous(), particle::mass.previous(),
                 particle::volume.previous(), particle::stress<D>.previous(), particle::viscous_pressure.previous())
          .accumulates(node::sums<D>.halo(1));
  const auto body = [&method](const TaskContext& at, auto data) {
    const auto sums = data[node::sums<D>];
    const auto block = block_of<D>(at.layout, sums);
    const Interpolator& interpolator = method.interpolator(at.group);
    const components::ParticleSources<D> sources{.position = data[particle::position<D>.previous()],
                                                 .velocity = data[particle::velocity<D>.previous()],
                                                 .mass = data[particle::mass.previous()],
                                                 .volume = data[particle::volume.previous()],
                                                 .stress = data[particle::stress<D>.previous()],
                                                 .viscous_pressure = data[particle::viscous_pressure.previous()]};
    components::particles_to_grid(interpolator, block, sources, sums.data());
    if constexpr (data.has(particle::velocity_gradient<D>)) {
      components::add_gradient_momentum(interpolator, block, sources.position, sources.mass,
                                        data[particle::velocity_gradient<D>.previous()], sums.data());
    }
    // The image behind a mirror gives to the grid as the particles do.
    for_each_wall(method, at, sums.box(), [&](const SymmetryWall<D>& wall) { wall.fold(sums.data()); });
  };
  if (method.transfer == Transfer::flip) return std::move(task).body(body);
  return std::move(task).reads(particle::velocity_gradient<D>.previous()).body(body);
}

template runtime::TaskDeclaration particles_to_grid(const Method<components::Gimp<2>>&);
template runtime::TaskDeclaration particles_to_grid(const Method<components::Gimp<3>>&);

}  // namespace tamp::tasks
